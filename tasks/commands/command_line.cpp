#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <sstream>
#include <stdexcept>
#include <string_view>
#include <utility>

#include "tasks/commands/command.hpp"
#include "tasks/commands/shared.hpp"
#include "tasks/io/place.hpp"
#include "tasks/io/standard_streams.hpp"
#include "tasks/io/version.hpp"

namespace isojam {

namespace {

constexpr auto exit_codes =
    "Exit codes: 0 all done; 1 some replicates failed, a resource failed (memory, threads, disk), or an output could "
    "not be written; 2 usage error, or a path on the command line cannot be read or written; 65 bad manifest, damaged "
    "record, or directory of another manifest; 75 interrupted, repeat the command to resume.";

void add_console_options(Options options, ConsoleOptions& console) {
  options.flag("--quiet", console.quiet, "Print only errors on stderr");
  options.flag("-v,--verbose", console.verbose, "Print a line for each replicate");
  options.choice("--color", console.colour, "Use colour on stderr");
  options.choice("--messages", console.form, "Set the format of messages on stderr (json: one object per line)");
}

void add_option_names(const CLI::App& app, std::vector<std::string>& names) {
  for (const auto* option : app.get_options()) {
    for (const auto& name : option->get_lnames()) names.push_back("--" + name);
    for (const auto& name : option->get_snames()) names.push_back("-" + name);
  }
}

/// Error text for the first unknown command or option. Empty if all are known.
std::string unknown_word(const CLI::App& app) {
  const auto given = app.get_subcommands();
  for (const auto& word : app.remaining(true)) {
    const bool option = word.size() > 1 && word[0] == '-';
    std::vector<std::string> names;
    if (option) {
      add_option_names(app, names);
      for (const auto* command : given) add_option_names(*command, names);
    } else if (given.empty()) {
      for (const auto* command : app.get_subcommands([](const CLI::App*) { return true; }))
        names.push_back(command->get_name());
    } else {
      continue;
    }
    const std::vector<std::string_view> known(names.begin(), names.end());
    const auto unknown = word.substr(0, option ? word.find('=') : std::string::npos);
    return unknown_name(option ? "option" : "command", unknown, known);
  }
  return "";
}

std::vector<std::string> choices_of(const std::string& type) {
  std::vector<std::string> choices;
  constexpr std::string_view between = ", ";
  for (std::size_t at = 0, comma = type.find(between); type.find(between) != std::string::npos && at < type.size();) {
    choices.push_back(type.substr(at, comma - at));
    at = comma == std::string::npos ? type.size() : comma + between.size();
    comma = type.find(between, at);
  }
  return choices;
}

std::vector<OptionDescription> described_options(const CLI::App& app) {
  std::vector<OptionDescription> list;
  for (const auto* option : app.get_options()) {
    OptionDescription described;
    for (const auto& name : option->get_snames()) described.names.push_back("-" + name);
    for (const auto& name : option->get_lnames()) described.names.push_back("--" + name);
    if (described.names.empty()) described.place = option->get_name();
    // A flag takes no value, even if it has a type name.
    if (option->get_items_expected_max() > 0) described.type = option->get_type_name();
    described.choices = choices_of(described.type);
    described.description = option->get_description();
    described.required = option->get_required();
    list.push_back(std::move(described));
  }
  return list;
}

ProgramDescription described_program(const CLI::App& app) {
  ProgramDescription program{.name = app.get_name(),
                             .description = app.get_description(),
                             .version = "isojam " + std::string(version()),
                             .footer = exit_codes,
                             .options = described_options(app),
                             .commands = {}};
  for (const auto* command : app.get_subcommands([](const CLI::App*) { return true; })) {
    auto options = described_options(*command);
    std::erase_if(options, [](const OptionDescription& option) {
      // Every command has --help, which is described once, with the program.
      return !option.names.empty() && option.names.back() == "--help";
    });
    program.commands.push_back({command->get_name(), command->get_description(), std::move(options)});
  }
  return program;
}

std::string not_accepted(const std::string& text, const std::string& allowed) {
  return "\"" + text + "\" is not accepted; expected " + allowed;
}

/// Error text if the number is not positive or not finite. Empty if it is positive and finite.
std::string not_positive(const std::string& text) {
  double value = 0;
  const bool good = CLI::detail::lexical_cast(text, value) && value > 0 && std::isfinite(value);
  return good ? "" : not_accepted(text, "a positive number");
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
      ->check([choices](const std::string& value) {
        if (std::find(choices.begin(), choices.end(), value) != choices.end()) return std::string();
        return unknown_name("value", value, std::vector<std::string_view>(choices.begin(), choices.end()));
      })
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
  constexpr int most_threads = 4096;
  app_.add_option("-j,--threads", threads, "Number of threads (default: as many as the machine has)")
      ->check([](const std::string& text) {
        int value = 0;
        const bool good = CLI::detail::lexical_cast(text, value) && value >= 1 && value <= most_threads;
        return good ? std::string() : not_accepted(text, integer_in({1, most_threads}));
      })
      ->type_name("N");
}

Options add_command(CLI::App& app, Session& session, const std::string& name, const std::string& description,
                    std::function<ExitCode(Console&)> work) {
  auto* command = app.add_subcommand(name, description);
  command->callback([&session, work = std::move(work)] { session.work = work; });
  return Options(*command);
}

std::optional<ExitCode> parse_command_line(int argc, char** argv, std::span<const AddCommand> commands,
                                           Session& session) {
  CLI::App app("isojam: compute and analyse jammed packings of soft frictionless convex solids", "isojam");
  app.require_subcommand(1);
  app.fallthrough();
  app.set_version_flag("--version", version_text());
  app.footer(exit_codes);
  add_console_options(Options(app), session.console);
  for (const AddCommand add : commands) add(app, session);
  session.program = described_program(app);
  try {
    app.parse(argc, argv);
  } catch (const std::invalid_argument& error) {
    std::fprintf(stderr, "isojam: error: %s\n", printable(error.what()).c_str());
    return ExitCode::usage;
  } catch (const CLI::ParseError& error) {
    if (const auto unknown = error.get_exit_code() == 0 ? std::string() : unknown_word(app); !unknown.empty()) {
      std::fprintf(stderr, "isojam: error: %s\n", printable(unknown).c_str());
      return ExitCode::usage;
    }
    std::ostringstream out, err;
    const bool asked = app.exit(error, out, err) == 0;
    print(out.str());
    if (!asked) std::fprintf(stderr, "isojam: error: %s", printable(err.str()).c_str());
    return asked ? ExitCode::done : ExitCode::usage;
  }
  return std::nullopt;
}

}  // namespace isojam
