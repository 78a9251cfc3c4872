#include "tasks/commands/command.hpp"
#include "tasks/commands/completions.hpp"
#include "tasks/commands/manual.hpp"
#include "tasks/io/atomic_file.hpp"
#include "tasks/io/standard_streams.hpp"

namespace isojam {
namespace {

struct Arguments {
  Shell shell = Shell::bash;
  std::string output;  ///< path of the output file; empty for standard output
};

void print_or_write(const std::string& text, const std::string& output) {
  if (output.empty()) {
    print(text);
  } else {
    write_output(output, text);
  }
}

}  // namespace

void add_completions(CLI::App& app, Session& session) {
  const auto arguments = std::make_shared<Arguments>();
  auto options =
      add_command(app, session, "completions", "Print a shell-completion script", [arguments, &session](Console&) {
        print_or_write(completions(session.program, arguments->shell), arguments->output);
        return ExitCode::done;
      });
  options.choice("shell", arguments->shell, "Shell for which the script is written", Options::Need::required);
  options.text("-o,--output", arguments->output, "Output file (default: standard output)", "FILE");
}

void add_manual(CLI::App& app, Session& session) {
  const auto arguments = std::make_shared<Arguments>();
  auto options = add_command(app, session, "manual", "Print the manual page in the format of man",
                             [arguments, &session](Console&) {
                               print_or_write(manual(session.program), arguments->output);
                               return ExitCode::done;
                             });
  options.text("-o,--output", arguments->output, "Output file (default: standard output)", "FILE");
}

}  // namespace isojam
