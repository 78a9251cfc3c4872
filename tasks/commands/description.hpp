#pragma once

#include <string>
#include <vector>

#include "tasks/io/exit_codes.hpp"

namespace isojam {

/// Description of an argument or option of a command or of the program.
struct OptionDescription {
  /// names with dashes, such as "-o" and "--output"; empty for a positional argument
  std::vector<std::string> names;
  std::string place;  ///< name of a positional argument; empty for an option
  /// name of the value in the help, such as DIR or FILE, or a list of the choices; empty for a flag
  std::string type;
  /// all allowed values if they are a list of names; otherwise empty
  std::vector<std::string> choices;
  std::string description;
  bool required = false;
  bool repeated = false;  ///< true if the user can give several values
};

struct CommandDescription {
  std::string name, description;
  std::vector<OptionDescription> options;
};

struct ExitCodeDescription {
  ExitCode code = ExitCode::done;
  std::string meaning;
};

/// Description of the whole command line. The help, the manual page and the completion scripts are made from it.
struct ProgramDescription {
  std::string name;
  std::string description;  ///< the name, and what the program does, without a full stop
  std::string version;
  std::vector<ExitCodeDescription> exit_codes;
  std::vector<OptionDescription> options;  ///< options of the program, which are allowed with every command
  std::vector<CommandDescription> commands;
};

}  // namespace isojam
