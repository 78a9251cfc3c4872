#pragma once

#include <string>
#include <vector>

namespace isojam {

/// A word that a command, or the program itself, takes, as its help shows it.
struct OptionDescription {
  std::vector<std::string> names;  ///< with their dashes; none if it is told by its place
  std::string place;               ///< what one told by its place is called
  std::string type;                ///< what the value is called: DIR, FILE … or the choices; empty of a flag
  std::vector<std::string> choices;
  std::string description;
  bool required = false;
};

struct CommandDescription {
  std::string name, description;
  std::vector<OptionDescription> options;
};

/// The command line as a value: what help, manual page and completions are made of.
struct ProgramDescription {
  std::string name, description, version, footer;
  std::vector<OptionDescription> options;  ///< that every command takes
  std::vector<CommandDescription> commands;
};

}  // namespace isojam
