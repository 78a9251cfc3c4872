#pragma once

#include <CLI/CLI.hpp>
#include <array>
#include <functional>
#include <string>

#include "engine/names/enum_names.hpp"
#include "tasks/system/console.hpp"
#include "tasks/system/exit_codes.hpp"

namespace isojam {

/// What a command line asks for: how to talk, and the work of the command that was given.
struct Session {
  ConsoleOptions console;
  std::function<ExitCode(Console&)> work;
};

/// Adds a command to the program: its options, and a callback that leaves its work in the session. What a command needs
/// lives as long as the app.
using AddCommand = void (*)(CLI::App& app, Session& session);

void add_run(CLI::App& app, Session& session);
void add_validate(CLI::App& app, Session& session);
void add_aggregate(CLI::App& app, Session& session);
void add_status(CLI::App& app, Session& session);
void add_rerun(CLI::App& app, Session& session);
void add_export(CLI::App& app, Session& session);
void add_report(CLI::App& app, Session& session);
void add_chart(CLI::App& app, Session& session);

/// Every command, in the order of the help.
inline constexpr std::array<AddCommand, 8> all_commands{add_run,   add_validate, add_aggregate, add_status,
                                                        add_rerun, add_export,   add_report,    add_chart};

/// A command of that name; its arguments live as long as `app` and are handed to `work` once all are read.
template <class Arguments>
CLI::App& add_command(CLI::App& app, Session& session, const std::string& name, const std::string& description,
                      Arguments*& arguments, ExitCode (*work)(const Arguments&, Console&)) {
  auto owned = std::make_shared<Arguments>();
  arguments = owned.get();
  auto* command = app.add_subcommand(name, description);
  command->callback(
      [&session, owned, work] { session.work = [owned, work](Console& console) { return work(*owned, console); }; });
  return *command;
}

/// An option that takes the name of an enumerator.
template <NamedEnum Enum>
CLI::Option* add_choice(CLI::App& app, const std::string& name, Enum& value, const std::string& description) {
  std::string list;
  for (const auto choice : all_names<Enum>) list += (list.empty() ? "" : ", ") + std::string(choice);
  return app
      .add_option_function<std::string>(
          name, [&value](const std::string& choice) { value = *from_string<Enum>(choice); }, description)
      ->check(CLI::IsMember(std::set<std::string>(all_names<Enum>.begin(), all_names<Enum>.end())).description(""))
      ->type_name(list);
}

/// Options that several commands have.
void add_results_directory(CLI::App& command, std::string& directory);
void add_threads(CLI::App& command, int& threads);

}  // namespace isojam
