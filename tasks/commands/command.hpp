#pragma once

#include <array>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/names/enum_names.hpp"
#include "tasks/commands/shell/description.hpp"
#include "tasks/system/console.hpp"
#include "tasks/system/exit_codes.hpp"

// CLI11 takes long to compile wherever it is included: it is seen by command_line.cpp alone.
// NOLINTNEXTLINE(readability-identifier-naming): CLI11 is called so
namespace CLI {
class App;
}  // namespace CLI

namespace isojam {

/// What a command line asks for: how to talk, and the work of the command that was given.
struct Session {
  ConsoleOptions console;
  std::function<ExitCode(Console&)> work;
  ProgramDescription program;  ///< the command line itself
};

/// The words that a command, or the program itself, takes. References must live as long as the app.
class Options {
 public:
  enum class Need : bool { optional, required };

  explicit Options(CLI::App& app) : app_(app) {}

  /// `name` is "word" for one that is told by its place, "-s,--long" for one that is told by its name; `type` is what
  /// the help calls the value.
  void text(const std::string& name, std::string& value, const std::string& description, const std::string& type,
            Need need = Need::optional);
  void texts(const std::string& name, std::vector<std::string>& values, const std::string& description,
             const std::string& type);
  void flag(const std::string& name, bool& value, const std::string& description);
  void positive(const std::string& name, double& value, const std::string& description, const std::string& type);
  /// `read` takes the text in, or says what is wrong with it. `absent` is called where the option is not given.
  void parsed(const std::string& name, const std::function<std::optional<std::string>(const std::string&)>& read,
              std::function<void()> absent, const std::string& description, const std::string& type);
  /// The name of an enumerator.
  template <NamedEnum Enum>
  void choice(const std::string& name, Enum& value, const std::string& description, Need need = Need::optional) {
    one_of(
        name, {all_names<Enum>.begin(), all_names<Enum>.end()},
        [&value](const std::string& choice) { value = *from_string<Enum>(choice); }, description, need);
  }
  /// Two that are not to be given together.
  void exclusive(const std::string& one, const std::string& other);

  void results_directory(std::string& directory);
  void threads(int& threads);

 private:
  void one_of(const std::string& name, const std::vector<std::string>& choices,
              const std::function<void(const std::string&)>& take, const std::string& description, Need need);

  CLI::App& app_;
};

/// A command of that name, and what is to be done if it is given.
Options add_command(CLI::App& app, Session& session, const std::string& name, const std::string& description,
                    std::function<ExitCode(Console&)> work);

/// A command whose work takes arguments: made here, handed to `work` once all are read.
template <class Arguments>
Options add_command(CLI::App& app, Session& session, const std::string& name, const std::string& description,
                    ExitCode (*work)(const Arguments&, Console&), Arguments*& arguments) {
  const auto owned = std::make_shared<Arguments>();
  arguments = owned.get();
  return add_command(app, session, name, description,
                     [owned, work](Console& console) { return work(*owned, console); });
}

/// Adds a command to the program: its options and its work.
using AddCommand = void (*)(CLI::App& app, Session& session);

void add_run(CLI::App& app, Session& session);
void add_validate(CLI::App& app, Session& session);
void add_aggregate(CLI::App& app, Session& session);
void add_status(CLI::App& app, Session& session);
void add_rerun(CLI::App& app, Session& session);
void add_measure(CLI::App& app, Session& session);
void add_export(CLI::App& app, Session& session);
void add_report(CLI::App& app, Session& session);
void add_chart(CLI::App& app, Session& session);
void add_completions(CLI::App& app, Session& session);
void add_manual(CLI::App& app, Session& session);

/// Every command, in the order of the help.
inline constexpr std::array<AddCommand, 11> all_commands{add_run,   add_validate,    add_aggregate, add_status,
                                                         add_rerun, add_measure,     add_export,    add_report,
                                                         add_chart, add_completions, add_manual};

/// Takes in the words that the program was called with: `session` gets its work. Where there is none, since help was
/// asked for or a word is wrong, it is printed, and this is what to exit with.
std::optional<ExitCode> parse_command_line(int argc, char** argv, Session& session);

}  // namespace isojam
