#include <CLI/CLI.hpp>
#include <cmath>
#include <set>
#include <utility>

#include "tasks/commands/command.hpp"

namespace isojam {

namespace {

/// What is wrong with the text of a number that must be positive and finite; empty if nothing is.
std::string not_positive(const std::string& text) {
  double value = 0;
  const bool good = CLI::detail::lexical_cast(text, value) && value > 0 && std::isfinite(value);
  return good ? "" : "not a positive number: " + text;
}

}  // namespace

void Options::text(const std::string& name, std::string& value, const std::string& description, const std::string& type,
                   Need need) {
  app_.add_option(name, value, description)->required(need == Need::required)->type_name(type);
}

void Options::texts(const std::string& name, std::vector<std::string>& values, const std::string& description,
                    const std::string& type) {
  app_.add_option(name, values, description)->required()->type_name(type);
}

void Options::flag(const std::string& name, bool& value, const std::string& description) {
  app_.add_flag(name, value, description);
}

void Options::positive(const std::string& name, double& value, const std::string& description,
                       const std::string& type) {
  app_.add_option(name, value, description)->check(not_positive)->type_name(type);
}

void Options::parsed(const std::string& name, const std::function<std::optional<std::string>(const std::string&)>& read,
                     std::function<void()> absent, const std::string& description, const std::string& type) {
  const auto* option = app_.add_option_function<std::string>(
                               name, [read](const std::string& text) { (void)read(text); }, description)
                           ->check([read](const std::string& text) { return read(text).value_or(""); })
                           ->type_name(type);
  app_.parse_complete_callback([option, absent = std::move(absent)] {
    if (option->count() == 0) absent();
  });
}

void Options::one_of(const std::string& name, const std::vector<std::string>& choices,
                     const std::function<void(const std::string&)>& take, const std::string& description, Need need) {
  std::string list;
  for (const auto& choice : choices) list += (list.empty() ? "" : ", ") + choice;
  app_.add_option_function<std::string>(name, take, description)
      ->check(CLI::IsMember(std::set<std::string>(choices.begin(), choices.end())).description(""))
      ->required(need == Need::required)
      ->type_name(list);
}

void Options::exclusive(const std::string& one, const std::string& other) {
  app_.get_option(one)->excludes(app_.get_option(other));
}

void Options::results_directory(std::string& directory) {
  text("directory", directory, "Results directory", "DIR", Need::required);
}

void Options::threads(int& threads) {
  app_.add_option("-j,--threads", threads, "Threads (default: as many as the machine gives)")
      ->check(CLI::Range(1, 4096).description(""))
      ->type_name("N");
}

Options add_command(CLI::App& app, Session& session, const std::string& name, const std::string& description,
                    std::function<ExitCode(Console&)> work) {
  auto* command = app.add_subcommand(name, description);
  command->callback([&session, work = std::move(work)] { session.work = work; });
  return Options(*command);
}

}  // namespace isojam
