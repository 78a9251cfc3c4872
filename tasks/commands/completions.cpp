#include <fmt/format.h>
#include <fmt/ranges.h>

#include <string_view>

#include "tasks/commands/command.hpp"
#include "tasks/commands/shared.hpp"

namespace isojam {

enum class Shell : std::uint8_t { bash, zsh, fish };
template <>
inline constexpr std::array enum_names<Shell>{EnumName{Shell::bash, "bash"}, EnumName{Shell::zsh, "zsh"},
                                              EnumName{Shell::fish, "fish"}};

namespace {

bool is_directory(const OptionDescription& option) { return option.type == "DIR"; }
bool is_path(const OptionDescription& option) {
  return is_directory(option) || option.type == "FILE" || option.type == "MANIFEST" || option.type == "CONFIG";
}

std::string names_of(const std::vector<OptionDescription>& options) {
  std::string all;
  for (const auto& option : options) {
    for (const auto& name : option.names) all += (all.empty() ? "" : " ") + name;
  }
  return all;
}

std::string replaced(std::string text, std::string_view what, std::string_view by) {
  for (auto at = text.find(what); at != std::string::npos; at = text.find(what, at + by.size()))
    text.replace(at, what.size(), by);
  return text;
}

/// Quotes a text for the shell, with single quotes.
std::string quoted(const std::string& text) { return "'" + replaced(text, "'", R"('\'')") + "'"; }

// ---- bash ----------------------------------------------------------------------------------------------------

/// Adds, for each option that takes a value, the branch that completes this value. The case statement tests the
/// previous argument.
void add_bash_values(const std::vector<OptionDescription>& options, const std::string& indent, std::string& script) {
  for (const auto& option : options) {
    if (option.names.empty() || option.type.empty()) continue;
    std::string reply = ":";
    if (!option.choices.empty()) {
      reply = fmt::format("mapfile -t COMPREPLY < <(compgen -W '{}' -- \"$word\")", fmt::join(option.choices, " "));
    } else if (is_path(option)) {
      reply = fmt::format("compopt -o filenames; mapfile -t COMPREPLY < <(compgen -{} -- \"$word\")",
                          is_directory(option) ? 'd' : 'f');
    }
    script += fmt::format("{}{}) {}; return ;;\n", indent, fmt::join(option.names, "|"), reply);
  }
}

/// Script that completes the arguments of a command. For a positional argument, it offers the choices or the names of
/// files.
std::string bash_command(const ProgramDescription& program, const CommandDescription& command) {
  std::string choices = names_of(command.options) + " " + names_of(program.options), compgen_action;
  for (const auto& option : command.options) {
    if (!option.names.empty()) continue;
    for (const auto& choice : option.choices) choices += " " + choice;
    if (is_path(option) && compgen_action != "f") compgen_action = is_directory(option) ? "d" : "f";
  }
  std::string script = fmt::format("    {})\n      case $before in\n", command.name);
  add_bash_values(command.options, "        ", script);
  script += "      esac\n";
  script += fmt::format("      mapfile -t COMPREPLY < <(compgen -W '{}' -- \"$word\")\n", choices);
  if (!compgen_action.empty()) {
    script += fmt::format(
        "      [[ $word == -* ]] || {{ compopt -o filenames; mapfile -t -O \"${{#COMPREPLY[@]}}\" COMPREPLY "
        "< <(compgen -{} -- \"$word\"); }}\n",
        compgen_action);
  }
  return script + "      ;;\n";
}

std::string bash_script(const ProgramDescription& program) {
  std::string names;
  for (const auto& command : program.commands) names += (names.empty() ? "" : " ") + command.name;
  std::string script = fmt::format(
      "# Completions of {0} for bash.\n_{0}() {{\n  local word=${{COMP_WORDS[COMP_CWORD]}} "
      "before=${{COMP_WORDS[COMP_CWORD-1]}} command= each\n  COMPREPLY=()\n"
      "  for each in \"${{COMP_WORDS[@]:1:COMP_CWORD-1}}\"; do\n"
      "    case $each in {1}) command=$each; break ;; esac\n  done\n  case $before in\n",
      program.name, replaced(names, " ", "|"));
  add_bash_values(program.options, "    ", script);
  script += "  esac\n  case $command in\n";
  for (const auto& command : program.commands) script += bash_command(program, command);
  script += fmt::format("    *) mapfile -t COMPREPLY < <(compgen -W '{} {}' -- \"$word\") ;;\n  esac\n}}\n", names,
                        names_of(program.options));
  return script + fmt::format("complete -F _{0} {0}\n", program.name);
}

// ---- zsh -----------------------------------------------------------------------------------------------------

std::string zsh_value(const OptionDescription& option) {
  if (option.type.empty()) return "";
  const std::string label = option.choices.empty() ? option.type : "value";
  if (!option.choices.empty()) return fmt::format(":{}:({})", label, fmt::join(option.choices, " "));
  if (is_directory(option)) return fmt::format(":{}:_files -/", label);
  return fmt::format(":{}:{}", label, is_path(option) ? "_files" : " ");
}

/// Replaces brackets and escapes colons, because both have a meaning in the descriptions that _arguments reads.
std::string zsh_text(const std::string& text) {
  return replaced(replaced(replaced(text, "[", "("), "]", ")"), ":", R"(\:)");
}

void add_zsh(const std::vector<OptionDescription>& options, const std::string& indent, std::string& script) {
  for (const auto& option : options) {
    const auto value = zsh_value(option);
    if (option.names.empty()) {
      const auto* position = option.repeated ? "*:" : option.required ? ":" : "::";
      script += " \\\n" + indent + quoted(position + zsh_text(option.place) + value.substr(value.rfind(':')));
    }
    for (const auto& name : option.names)
      script += " \\\n" + indent + quoted(fmt::format("{}[{}]{}", name, zsh_text(option.description), value));
  }
}

/// The first _arguments completes the options of the program, which may precede the command, and finds the command.
/// Then `words` begins with the command.
std::string zsh_script(const ProgramDescription& program) {
  std::string script = fmt::format(
      "#compdef {0}\n# Completions of {0} for zsh.\n_{0}() {{\n  local curcontext=\"$curcontext\" state line\n"
      "  local -a commands\n  commands=(\n",
      program.name);
  for (const auto& command : program.commands)
    script += "    " + quoted(command.name + ":" + zsh_text(command.description)) + "\n";
  script += "  )\n  _arguments -C -A '-*'";
  add_zsh(program.options, "    ", script);
  script +=
      " \\\n    '1:command:->command' \\\n    '*::argument:->arguments'\n"
      "  if [[ $state == command ]]; then\n    _describe command commands\n    return\n  fi\n"
      "  [[ $state == arguments ]] || return\n  case $words[1] in\n";
  for (const auto& command : program.commands) {
    script += fmt::format("    {})\n      _arguments", command.name);
    add_zsh(command.options, "        ", script);
    add_zsh(program.options, "        ", script);
    script += " ;;\n";
  }
  return script + fmt::format("  esac\n}}\n_{0} \"$@\"\n", program.name);
}

// ---- fish ----------------------------------------------------------------------------------------------------

void add_fish(const std::string& program, const std::string& condition, const std::vector<OptionDescription>& options,
              std::string& script) {
  for (const auto& option : options) {
    std::string line = fmt::format("complete -c {} -n {}", program, quoted(condition));
    for (const auto& name : option.names)
      line += name.starts_with("--") ? " -l " + name.substr(2) : " -s " + name.substr(1);
    if (!option.names.empty() && !option.type.empty()) line += is_path(option) ? " -r" : " -x";
    if (!option.choices.empty()) line += " -a " + quoted(fmt::format("{}", fmt::join(option.choices, " ")));
    if (option.choices.empty() && is_path(option))
      line += option.names.empty() || is_directory(option)
                  ? fmt::format(" -f -a '(__fish_complete_{})'", is_directory(option) ? "directories" : "path")
                  : " -F";
    script += line + " -d " + quoted(option.description) + "\n";
  }
}

std::string fish_script(const ProgramDescription& program) {
  std::string script = fmt::format("# Completions of {0} for fish.\ncomplete -c {0} -f\n", program.name);
  for (const auto& command : program.commands) {
    script += fmt::format("complete -c {} -n __fish_use_subcommand -a {} -d {}\n", program.name, command.name,
                          quoted(command.description));
  }
  for (const auto& command : program.commands)
    add_fish(program.name, "__fish_seen_subcommand_from " + command.name, command.options, script);
  add_fish(program.name, "true", program.options, script);
  return script;
}

/// The completion script for a shell. It completes commands, options, their values, and names of files and directories.
std::string completions(const ProgramDescription& program, Shell shell) {
  switch (shell) {
    case Shell::bash: return bash_script(program);
    case Shell::zsh: return zsh_script(program);
    case Shell::fish: return fish_script(program);
  }
  return "";
}

struct CompletionArguments {
  Shell shell = Shell::bash;
  std::string output;  ///< path of the output file; empty for standard output
};

}  // namespace

void add_completions(CLI::App& app, Session& session) {
  const auto arguments = std::make_shared<CompletionArguments>();
  auto options =
      add_command(app, session, "completions", "Print a shell-completion script", [arguments, &session](Console&) {
        print_or_write(completions(session.program, arguments->shell), arguments->output);
        return ExitCode::done;
      });
  options.choice("shell", arguments->shell, "Shell for which the script is written", Options::Need::required);
  options.text("-o,--output", arguments->output, "Output file (default: standard output)", "FILE");
}

}  // namespace isojam
