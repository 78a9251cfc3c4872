#include <CLI/CLI.hpp>
#include <csignal>
#include <cstdio>
#include <stdexcept>

#include "tasks/commands/command.hpp"
#include "tasks/json/input_error.hpp"
#include "tasks/system/file.hpp"
#include "tasks/system/version.hpp"

namespace isojam {
namespace {

constexpr auto exit_codes =
    "Exit codes: 0 all done; 1 some replicates failed, or results could no longer be written; 2 usage, or a path on "
    "the command line that cannot be read or written; 65 bad manifest or record, or a directory of another manifest; "
    "75 interrupted, the same command continues.";

void add_console_options(Options options, ConsoleOptions& console) {
  options.flag("--quiet", console.quiet, "Errors only on stderr");
  options.flag("-v,--verbose", console.verbose, "A line for each replicate");
  options.choice("--color", console.colour, "Colour on stderr");
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
    std::fprintf(stderr, "isojam: error: %s\n", error.what());
    return ExitCode::usage;
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? ExitCode::done : ExitCode::usage;
  }

  Console console(session.console);
  try {
    return session.work(console);
  } catch (const InputError& error) {
    console.error(error.what());
    return ExitCode::bad_input;
  } catch (const FileError& error) {
    console.error(error.what());
    return ExitCode::usage;
  }
}

}  // namespace
}  // namespace isojam

int main(int argc, char** argv) {
  // A file that may not grow is a failed write like any other, not the end.
  std::signal(SIGXFSZ, SIG_IGN);
  try {
    return static_cast<int>(isojam::parse_and_run(argc, argv));
  } catch (const std::exception& error) {
    std::fprintf(stderr, "isojam: error: %s\n", error.what());
    return static_cast<int>(isojam::ExitCode::some_failed);
  }
}
