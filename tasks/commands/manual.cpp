#include <fmt/format.h>
#include <fmt/ranges.h>

#include "tasks/commands/command.hpp"
#include "tasks/io/atomic_file.hpp"
#include "tasks/io/standard_streams.hpp"

namespace isojam {
namespace {

/// Escapes a text for troff. Hyphens stay hyphens, so that options can be copied. A text that begins with . or ' would
/// be an instruction to troff, so it gets a prefix.
std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (c == '\\') {
      out += "\\e";
    } else if (c == '-') {
      out += "\\-";
    } else {
      out += c;
    }
  }
  return out.starts_with('.') || out.starts_with('\'') ? "\\&" + out : out;
}

void add_options(const std::vector<OptionDescription>& options, std::string& page) {
  for (const auto& option : options) {
    const std::string name = option.names.empty() ? option.place : fmt::format("{}", fmt::join(option.names, ", "));
    page += ".TP\n" + std::string(option.names.empty() ? "\\fI" : "\\fB") + escaped(name) + "\\fR";
    if (!option.names.empty() && !option.type.empty()) page += " \\fI" + escaped(option.type) + "\\fR";
    if (option.repeated) page += " ...";
    page += "\n" + escaped(option.description) + (option.required && !option.names.empty() ? " (required)" : "") + "\n";
    if (option.names.empty() && !option.choices.empty()) page += "One of " + escaped(option.type) + ".\n";
  }
}

std::string synopsis(const CommandDescription& command) {
  std::string line = " [\\fIoptions\\fR]";
  for (const auto& option : command.options) {
    if (!option.names.empty()) continue;
    const std::string type = option.choices.empty() && !option.type.empty() ? option.type : option.place;
    line += option.required ? " \\fI" + escaped(type) + "\\fR" : " [\\fI" + escaped(type) + "\\fR]";
    if (option.repeated) line += " ...";
  }
  return line;
}

/// The text of the manual page isojam(1), with man macros.
std::string manual(const ProgramDescription& program) {
  std::string page = fmt::format(".TH {} 1 \"\" \"{}\" \"User Commands\"\n", program.name, program.version);
  page += ".SH NAME\n" + escaped(program.name) + " \\- " +
          escaped(program.description.substr(program.name.size() + 1)) + "\n.SH SYNOPSIS\n";
  for (const auto& command : program.commands)
    page += fmt::format(".B {} {}\n", program.name, command.name) + synopsis(command).substr(1) + "\n.br\n";
  page += ".SH DESCRIPTION\n" + escaped(program.description) +
          ".\nResults go to the standard output. Messages go to the standard error.\n";
  page += ".SH COMMANDS\n";
  for (const auto& command : program.commands) {
    page += ".SS " + escaped(command.name) + "\n" + escaped(command.description) + ".\n";
    add_options(command.options, page);
  }
  page += ".SH GENERAL OPTIONS\n";
  add_options(program.options, page);
  page += ".SH EXIT STATUS\n";
  for (const auto& [code, meaning] : program.exit_codes)
    page += fmt::format(".TP\n\\fB{}\\fR\n{}\n", static_cast<int>(code), escaped(meaning));
  return page;
}

}  // namespace

void print_or_write(const std::string& text, const std::string& output) {
  if (output.empty()) {
    print(text);
  } else {
    write_output(output, text);
  }
}

void add_manual(CLI::App& app, Session& session) {
  const auto output = std::make_shared<std::string>();
  auto options =
      add_command(app, session, "manual", "Print the manual page in the format of man", [output, &session](Console&) {
        print_or_write(manual(session.program), *output);
        return ExitCode::done;
      });
  options.text("-o,--output", *output, "Output file (default: standard output)", "FILE");
}

}  // namespace isojam
