#include <CLI/CLI.hpp>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <new>
#include <sstream>
#include <stdexcept>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include "tasks/commands/command.hpp"
#include "tasks/json/input_error.hpp"
#include "tasks/json/place.hpp"
#include "tasks/system/file.hpp"
#include "tasks/system/shortage.hpp"
#include "tasks/system/standard_streams.hpp"
#include "tasks/system/version.hpp"

namespace isojam {
namespace {

constexpr auto exit_codes =
    "Exit codes: 0 all done; 1 some replicates failed, or the machine lacked something, or output could not be "
    "written; 2 usage, or a path on the command line that cannot be read or written; 65 bad manifest or record, or a "
    "directory of another manifest; 75 interrupted, the same command continues.";

void add_console_options(Options options, ConsoleOptions& console) {
  options.flag("--quiet", console.quiet, "Errors only on stderr");
  options.flag("-v,--verbose", console.verbose, "A line for each replicate");
  options.choice("--color", console.colour, "Colour on stderr");
}

void add_option_names(const CLI::App& app, std::vector<std::string>& names) {
  for (const auto* option : app.get_options()) {
    for (const auto& name : option->get_lnames()) names.push_back("--" + name);
    for (const auto& name : option->get_snames()) names.push_back("-" + name);
  }
}

/// What is wrong with the first command or option that is none; empty if all are known.
std::string unknown_word(const CLI::App& app) {
  const auto given = app.get_subcommands();
  for (const auto& word : app.remaining(true)) {
    const bool option = word.size() > 1 && word[0] == '-';
    std::vector<std::string> names;
    if (option) {
      add_option_names(app, names);
      for (const auto* command : given) add_option_names(*command, names);
    } else if (given.empty()) {
      for (const auto* command : app.get_subcommands([](const CLI::App*) { return true; }))
        names.push_back(command->get_name());
    } else {
      continue;
    }
    const std::vector<std::string_view> known(names.begin(), names.end());
    const auto unknown = word.substr(0, option ? word.find('=') : std::string::npos);
    const auto suggestion = nearest_name(unknown, known);
    return (option ? "unknown option \"" : "unknown command \"") + unknown + "\"; " +
           (suggestion.empty() ? "allowed: " + quoted_list(known) : "did you mean \"" + suggestion + "\"?");
  }
  return "";
}

ExitCode parse_and_run(int argc, char** argv) {
  CLI::App app("isojam: jammed packings of soft frictionless Platonic solids, in batches", "isojam");
  Session session;
  app.require_subcommand(1);
  app.fallthrough();
  app.set_version_flag("--version", "isojam " + std::string(version()) + " (" + std::string(git_hash()) + ")");
  app.footer(exit_codes);
  add_console_options(Options(app), session.console);
  for (const AddCommand add : all_commands) add(app, session);
  try {
    app.parse(argc, argv);
  } catch (const std::invalid_argument& error) {
    std::fprintf(stderr, "isojam: error: %s\n", printable(error.what()).c_str());
    return ExitCode::usage;
  } catch (const CLI::ParseError& error) {
    if (const auto unknown = error.get_exit_code() == 0 ? std::string() : unknown_word(app); !unknown.empty()) {
      std::fprintf(stderr, "isojam: error: %s\n", printable(unknown).c_str());
      return ExitCode::usage;
    }
    std::ostringstream out, err;
    const bool asked = app.exit(error, out, err) == 0;
    print(out.str());
    if (!asked) std::fprintf(stderr, "isojam: error: %s", printable(err.str()).c_str());
    return asked ? ExitCode::done : ExitCode::usage;
  }

  Console console(session.console);
  try {
    return session.work(console);
  } catch (const InputError& error) {
    for (const auto& each : error.all()) console.error(one_line(each));
    return ExitCode::bad_input;
  } catch (const FileError& error) {
    console.error(error.what());
    return error.reason() == FileError::Reason::shortage ? ExitCode::some_failed : ExitCode::usage;
  }
}

/// What the machine lacks ends the program wherever it is missed, also where nothing may be thrown.
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
  // At the first allocation that fails, before anything is unwound: not all that would be can bear it.
  std::set_new_handler([] { isojam::end_for_want("the machine has no more memory to give"); });
  // A file that may not grow is a failed write like any other, not the end.
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
