#include "tasks/commands/manual.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace isojam {
namespace {

/// Escapes a text for troff: backslashes, hyphens (which must appear as the hyphens of options), and a first character
/// that would make the text a request.
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
  }
  return line;
}

}  // namespace

std::string manual(const ProgramDescription& program) {
  std::string page = fmt::format(".TH {} 1 \"\" \"{}\" \"User Commands\"\n", program.name, program.version);
  page += ".SH NAME\n" + escaped(program.name) + " \\- " +
          escaped(program.description.substr(program.description.find(": ") + 2)) + "\n.SH SYNOPSIS\n";
  for (const auto& command : program.commands)
    page += fmt::format(".B {} {}\n", program.name, command.name) + synopsis(command).substr(1) + "\n.br\n";
  page += ".SH DESCRIPTION\n" + escaped(program.description) +
          ".\nResults go to standard output, messages to standard error.\n";
  page += ".SH COMMANDS\n";
  for (const auto& command : program.commands) {
    page += ".SS " + escaped(command.name) + "\n" + escaped(command.description) + ".\n";
    add_options(command.options, page);
  }
  page += ".SH OPTIONS OF EVERY COMMAND\n";
  add_options(program.options, page);
  return page + ".SH EXIT STATUS\n" + escaped(program.footer) + "\n";
}

}  // namespace isojam
