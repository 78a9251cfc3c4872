#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <new>
#include <system_error>

#include "tasks/commands/command.hpp"
#include "tasks/json/input_error.hpp"
#include "tasks/system/file.hpp"
#include "tasks/system/shortage.hpp"
#include "tasks/system/standard_streams.hpp"

namespace isojam {
namespace {

ExitCode parse_and_run(int argc, char** argv) {
  Session session;
  if (const auto ended = parse_command_line(argc, argv, session)) return *ended;
  Console console(session.console);
  try {
    return session.work(console);
  } catch (const InputError& error) {
    for (const auto& each : error.all()) {
      console.error(one_line(each), {{"file", each.file},
                                     {"pointer", each.pointer},
                                     {"problem", each.problem},
                                     {"allowed", each.allowed},
                                     {"suggestion", each.suggestion}});
    }
    return ExitCode::bad_input;
  } catch (const FileError& error) {
    console.error(error.what());
    return error.reason() == FileError::Reason::shortage ? ExitCode::some_failed : ExitCode::usage;
  }
}

/// Ends the program after a resource failure, also in code that must not throw.
[[noreturn]] void end_for_want(const char* what) {
  std::fprintf(stderr, "isojam: error: %s; what was recorded is kept, and the same command continues\n", what);
  std::_Exit(static_cast<int>(ExitCode::some_failed));
}

[[noreturn]] void terminated() {
  try {
    if (const auto error = std::current_exception()) std::rethrow_exception(error);
  } catch (const std::bad_alloc&) {
    end_for_want("the machine has no more memory to give");
  } catch (const std::system_error& error) {
    end_for_want(error.what());
  } catch (...) {
    std::fputs("isojam: error: an exception that nothing caught\n", stderr);
  }
  std::abort();
}

}  // namespace
}  // namespace isojam

int main(int argc, char** argv) {
  isojam::open_standard_streams();
  std::set_terminate(isojam::terminated);
  // Called at the first failed allocation, before unwinding, because not all code on the stack survives it.
  std::set_new_handler([] { isojam::end_for_want("the machine has no more memory to give"); });
  // A file that must not grow is then an ordinary failed write.
  std::signal(SIGXFSZ, SIG_IGN);
  try {
    const auto code = isojam::parse_and_run(argc, argv);
    isojam::flush_output();
    return static_cast<int>(code);
  } catch (const std::bad_alloc&) {
    isojam::end_for_want("the machine has no more memory to give");
  } catch (const std::system_error& error) {
    const bool thread = error.code() == std::errc::resource_unavailable_try_again;
    isojam::end_for_want(thread ? "the machine has no more threads to give" : error.what());
  } catch (const isojam::FileError& error) {
    std::fprintf(stderr, "isojam: error: %s\n", isojam::printable(error.what()).c_str());
    return static_cast<int>(isojam::ExitCode::some_failed);
  } catch (const std::exception& error) {
    if (isojam::is_shortage(error)) isojam::end_for_want(error.what());
    std::fprintf(stderr, "isojam: error: %s\n", isojam::printable(error.what()).c_str());
    return static_cast<int>(isojam::ExitCode::some_failed);
  }
}
