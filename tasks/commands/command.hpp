#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "engine/names/enum_names.hpp"
#include "tasks/commands/description.hpp"
#include "tasks/io/console.hpp"
#include "tasks/io/exit_codes.hpp"

// CLI11 takes long to compile, so only command_line.cpp includes it.
// NOLINTNEXTLINE(readability-identifier-naming): the library has this name
namespace CLI {
class App;
}  // namespace CLI

namespace isojam {

/// Result of parsing the command line: the options of the output, and the function to call.
struct Session {
  ConsoleOptions console;
  /// calls the function of the chosen command
  std::function<ExitCode(Console&)> work;
  ProgramDescription program;  ///< description of all commands and options
};

/// Defines the arguments and options of a command or of the program. The variables that are passed by reference must
/// exist as long as the app.
class Options {
 public:
  enum class Need : bool { optional, required };

  explicit Options(CLI::App& app) : app_(app) {}

  /// `name` has the form "manifest" for a positional argument, and the form "-o,--output" for an option. `type` is the
  /// name of the value in the help, such as FILE.
  void text(const std::string& name, std::string& value, const std::string& description, const std::string& type,
            Need need = Need::optional);
  void texts(const std::string& name, std::vector<std::string>& values, const std::string& description,
             const std::string& type);
  void flag(const std::string& name, bool& value, const std::string& description);
  void positive(const std::string& name, double& value, const std::string& description, const std::string& type);
  /// An option with its own syntax. `read` parses its text, and returns an error message if the text is invalid.
  /// `when_absent` is called if the user does not give the option.
  void parsed(const std::string& name, const std::function<std::optional<std::string>(const std::string&)>& read,
              std::function<void()> when_absent, const std::string& description, const std::string& type);
  /// An option with an enumeration: its value is the name of an enumerator.
  template <NamedEnum Enum>
  void choice(const std::string& name, Enum& value, const std::string& description, Need need = Need::optional) {
    one_of(
        name, {all_names<Enum>.begin(), all_names<Enum>.end()},
        [&value](const std::string& choice) { value = *from_string<Enum>(choice); }, description, need);
  }

  void results_directory(std::string& directory);
  void threads(int& threads);

 private:
  void one_of(const std::string& name, const std::vector<std::string>& choices,
              const std::function<void(const std::string&)>& take, const std::string& description, Need need);

  CLI::App& app_;
};

/// Adds a command. `work` is called if the user chooses this command.
Options add_command(CLI::App& app, Session& session, const std::string& name, const std::string& description,
                    std::function<ExitCode(Console&)> work);

/// Adds a command whose function takes arguments. Creates the object that stores them, and sets `arguments` to it.
/// After the command line was parsed, `work` receives this object.
template <class Arguments>
Options add_command(CLI::App& app, Session& session, const std::string& name, const std::string& description,
                    ExitCode (*work)(const Arguments&, Console&), Arguments*& arguments) {
  const auto owned = std::make_shared<Arguments>();
  arguments = owned.get();
  return add_command(app, session, name, description,
                     [owned, work](Console& console) { return work(*owned, console); });
}

/// A function that adds one command with its options to the program.
using AddCommand = void (*)(CLI::App& app, Session& session);

void add_run(CLI::App& app, Session& session);
void add_validate(CLI::App& app, Session& session);
void add_aggregate(CLI::App& app, Session& session);
void add_status(CLI::App& app, Session& session);
void add_fields(CLI::App& app, Session& session);
void add_schema(CLI::App& app, Session& session);
void add_rerun(CLI::App& app, Session& session);
void add_measure(CLI::App& app, Session& session);
void add_completions(CLI::App& app, Session& session);
void add_manual(CLI::App& app, Session& session);

/// Parses the command line, and stores the function of the chosen command in `session`. The help lists the commands in
/// the order of `commands`. If the user asked for the help or the version, or made an error, there is no function to
/// call. The text of the help, version or error is then printed, and the exit code is returned. Otherwise returns
/// nullopt.
std::optional<ExitCode> parse_command_line(int argc, char** argv, std::span<const AddCommand> commands,
                                           Session& session);

}  // namespace isojam
