#pragma once

#include <string>
#include <vector>

namespace isojam {

/// An argument or option of a command or of the program, as the help shows it.
struct OptionDescription {
  /// names with their dashes, such as "-o" and "--output"; empty for a positional argument
  std::vector<std::string> names;
  std::string place;  ///< name of a positional argument
  std::string type;   ///< name of the value in the help, such as DIR or FILE, or the choices; empty for a flag
  std::vector<std::string> choices;
  std::string description;
  bool required = false;
};

struct CommandDescription {
  std::string name, description;
  std::vector<OptionDescription> options;
};

/// Description of the whole command line, from which the help, the manual page and the completions are made.
struct ProgramDescription {
  std::string name, description, version, footer;
  std::vector<OptionDescription> options;  ///< options of every command
  std::vector<CommandDescription> commands;
};

}  // namespace isojam
