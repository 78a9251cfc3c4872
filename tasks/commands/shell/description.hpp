#pragma once

#include <string>
#include <vector>

namespace isojam {

/// An argument or option of a command or of the program, as its help shows it.
struct OptionDescription {
  std::vector<std::string> names;  ///< with their dashes; empty for a positional argument
  std::string place;               ///< name of a positional argument
  std::string type;                ///< name of the value: DIR, FILE … or the choices; empty for a flag
  std::vector<std::string> choices;
  std::string description;
  bool required = false;
};

struct CommandDescription {
  std::string name, description;
  std::vector<OptionDescription> options;
};

/// The command line as a value, from which help, manual page and completions are made.
struct ProgramDescription {
  std::string name, description, version, footer;
  std::vector<OptionDescription> options;  ///< accepted by every command
  std::vector<CommandDescription> commands;
};

}  // namespace isojam
