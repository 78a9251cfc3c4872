#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <new>
#include <string_view>
#include <system_error>

#include "tasks/commands/command.hpp"
#include "tasks/io/file.hpp"
#include "tasks/io/input_error.hpp"
#include "tasks/io/process.hpp"
#include "tasks/io/resource_failure.hpp"
#include "tasks/io/standard_streams.hpp"
#include "tasks/io/texts.hpp"
#include "tasks/io/usage_error.hpp"

#ifdef ISOJAM_EXTRAS
#include "tasks/extras/commands/extra_commands.hpp"
#endif

namespace isojam {
namespace {

constexpr AddCommand commands[]{add_run,    add_validate, add_aggregate,   add_status, add_rerun, add_measure,
#ifdef ISOJAM_EXTRAS
                                add_export, add_report,   add_chart,
#endif
                                add_fields, add_schema,   add_completions, add_manual};

ExitCode parse_and_run(int argc, char** argv) {
  Session session;
  if (const auto ended = parse_command_line(argc, argv, commands, session)) return *ended;
  Console console(session.console);
  try {
    return session.work(console);
  } catch (const InputError& error) {
    for (const auto& each : error.all()) {
      console.error(one_line(each), {{"file", each.file},
                                     {"pointer", each.pointer},
                                     {"problem", each.problem},
                                     {"allowed", each.correction()},
                                     {"suggestion", each.suggestion}});
    }
    return ExitCode::bad_input;
  } catch (const UsageError& error) {
    console.error(error.what());
    return ExitCode::usage;
  } catch (const FileError& error) {
    console.error(error.what());
    // A missing file of a results directory is an InputError, so this path is from the command line.
    const bool wrong_path =
        error.reason() == FileError::Reason::missing || error.reason() == FileError::Reason::no_file;
    return wrong_path ? ExitCode::usage : ExitCode::some_failed;
  }
}

constexpr auto out_of_memory = "out of memory";
constexpr auto no_thread = "cannot create another thread; use fewer threads (-j N), or raise the limit of processes";

/// Text about a resource failure.
const char* text_of(const std::exception& error) {
  if (dynamic_cast<const std::bad_alloc*>(&error)) return out_of_memory;
  const auto* system = dynamic_cast<const std::system_error*>(&error);
  const bool thread = system ? system->code() == std::errc::resource_unavailable_try_again
                             : std::string_view(error.what()).starts_with("pthread_");  // the text of oneTBB
  return thread ? no_thread : error.what();
}

/// Ends the program after a resource failure. Can also be called from code that must not throw.
[[noreturn]] void end_after_resource_failure(const char* what) {
  std::fprintf(stderr, "isojam: error: %s; %s\n", what, how_to_resume.data());
  std::_Exit(static_cast<int>(ExitCode::some_failed));
}

[[noreturn]] void terminated() {
  try {
    if (const auto error = std::current_exception()) std::rethrow_exception(error);
  } catch (const std::bad_alloc& error) {
    end_after_resource_failure(text_of(error));
  } catch (const std::system_error& error) {
    end_after_resource_failure(text_of(error));
  } catch (...) {
    std::fputs("isojam: error: unhandled exception of unknown type\n", stderr);
  }
  std::abort();
}

/// Runs the command, and converts each exception to an error message and an exit code.
int exit_code_of(int argc, char** argv) {
  try {
    const auto code = parse_and_run(argc, argv);
    flush_output();
    return static_cast<int>(code);
  } catch (const FileError& error) {
    std::fprintf(stderr, "isojam: error: %s\n", printable(error.what()).c_str());
    return static_cast<int>(ExitCode::some_failed);
  } catch (const std::exception& error) {
    if (is_resource_failure(error)) end_after_resource_failure(text_of(error));
    std::fprintf(stderr, "isojam: error: %s\n", printable(error.what()).c_str());
    return static_cast<int>(ExitCode::some_failed);
  }
}

}  // namespace
}  // namespace isojam

int main(int argc, char** argv) {
  isojam::open_standard_streams();
  std::set_terminate(isojam::terminated);
  // The handler is called at the first failed allocation, before the stack is unwound. Not all functions on the stack
  // would survive an exception.
  std::set_new_handler([] { isojam::end_after_resource_failure(isojam::out_of_memory); });
  // Writing to a file that must not grow then fails like any other write, instead of ending the program by a signal.
  std::signal(SIGXFSZ, SIG_IGN);
  try {
    return isojam::with_enough_stack([&] { return isojam::exit_code_of(argc, argv); });
  } catch (const std::system_error& error) {
    isojam::end_after_resource_failure(isojam::text_of(error));
  }
}
