#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
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

std::vector<ExitCodeDescription> exit_codes() {
  return {{ExitCode::done, "no error"},
          {ExitCode::some_failed,
           "a replicate failed; a resource ran out (memory, threads, disk); or a file could not be read or written"},
          {ExitCode::usage,
           "wrong command line; or a path in it is missing or of the wrong kind; or the replicate has no packing"},
          {ExitCode::bad_input, "error in a manifest, damaged or missing results, or directory of another manifest"},
          {ExitCode::interrupted, "interrupted; repeat the command to resume"}};
}

constexpr auto examples =
    "Examples:\n"
    "  isojam run examples/01-four-solids/manifest.json\n"
    "  isojam aggregate results/four-solids --all\n"
    "  isojam report results/four-solids\n\n";

std::string help_footer() {
  std::string text = "Exit codes:\n";
  for (const auto& [code, meaning] : exit_codes())
    text += fmt::format("  {:>2}: {}\n", static_cast<int>(code), meaning);
  return text;
}

void add_console_options(Options options, ConsoleOptions& console) {
  options.flag("--quiet", console.quiet, "Print no messages except errors (tables are still printed)");
  options.flag("-v,--verbose", console.verbose, "Print a line for each finished replicate");
  options.choice("--color", console.colour, "Use colour on stderr");
  options.choice(
      "--messages", console.form,
      "Set the format of messages on stderr; with json, each line is one object, except errors in the command line");
}

void add_option_names(const CLI::App& app, std::vector<std::string>& names) {
  for (const auto* option : app.get_options()) {
    for (const auto& name : option->get_lnames()) names.push_back("--" + name);
    for (const auto& name : option->get_snames()) names.push_back("-" + name);
  }
}

/// Ending of an error message that names the help of the command in which the error is.
std::string see_help(const std::vector<CLI::App*>& given) {
  return fmt::format("; see \"isojam{} --help\"", given.empty() ? "" : " " + given.front()->get_name());
}

/// The short name of an option that begins with the same letter as the unknown long name `unknown`; empty if there is
/// none.
std::string short_option(const CLI::App& app, const std::string& unknown) {
  if (!unknown.starts_with("--") || unknown.size() < 3) return "";
  for (const auto* command : app.get_subcommands()) {
    const auto* option = command->get_option_no_throw("-" + unknown.substr(2, 1));
    if (option != nullptr) return "-" + unknown.substr(2, 1);
  }
  return "";
}

/// Returns an error text for the first unknown command or option, or for the first argument that is too many. Returns
/// an empty text if there is none.
std::string unexpected_argument(const CLI::App& app) {
  const auto given = app.get_subcommands();
  const auto remaining = app.remaining(true);
  for (const auto& argument : remaining) {
    const bool option = argument.size() > 1 && argument[0] == '-';
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
    const auto unknown = argument.substr(0, option ? argument.find('=') : std::string::npos);
    // Every name of one letter is similar to every other one, so none of them is suggested.
    std::erase_if(names, [](const std::string& name) { return name.size() == 2; });
    std::vector<std::string_view> known;
    for (const auto& name : names) {
      if (std::find(known.begin(), known.end(), name) == known.end()) known.push_back(name);
    }
    const auto short_name = short_option(app, unknown);
    if (!short_name.empty() && nearest_name(unknown, known).empty())
      return fmt::format("unknown option \"{}\"; did you mean \"{}\"?", unknown, short_name);
    return unknown_name(option ? "option" : "command", unknown, known);
  }
  return remaining.empty() ? "" : fmt::format("unexpected argument \"{}\"{}", remaining.front(), see_help(given));
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

/// Ending of an error message that lists the choices; empty if the type is not a list of choices.
std::string expected_choice(const std::string& type) {
  const auto choices = choices_of(type);
  if (choices.empty()) return "";
  return "; expected " + one_of(std::vector<std::string_view>(choices.begin(), choices.end()));
}

/// Ending of an error message that describes the values of a type.
std::string expected_value(const std::string& type) {
  if (auto choice = expected_choice(type); !choice.empty()) return choice;
  const std::map<std::string_view, std::string_view> texts{
      {"N", "an integer"}, {"FILE", "a path"}, {"DIR", "a path"}, {"GIB", "a positive number"}};
  const auto found = texts.find(type);
  return fmt::format("; expected {}", found == texts.end() ? type : found->second);
}

/// Returns an error text if the command, or a required argument of it, is missing. Otherwise returns an empty text.
std::string missing_argument(const CLI::App& app) {
  const auto given = app.get_subcommands();
  if (given.empty()) return "a command is required" + see_help(given);
  for (const auto* option : given.front()->get_options()) {
    if (!option->get_required() || option->count() > 0) continue;
    const auto type = option->get_type_name();
    const auto choice = expected_choice(type);
    const auto name = option->get_positional() && choice.empty() ? type : option->get_name();
    return fmt::format("{} is required{}", name, choice.empty() ? see_help(given) : choice);
  }
  return "";
}

std::vector<OptionDescription> describe_options(const CLI::App& app) {
  std::vector<OptionDescription> list;
  for (const auto* option : app.get_options()) {
    OptionDescription described;
    for (const auto& name : option->get_snames()) described.names.push_back("-" + name);
    for (const auto& name : option->get_lnames()) described.names.push_back("--" + name);
    if (described.names.empty()) described.place = option->get_name();
    described.repeated = option->get_items_expected_max() > 1;
    // A flag takes no value, even if it has a type name.
    if (option->get_items_expected_max() > 0) described.type = option->get_type_name();
    described.choices = choices_of(described.type);
    described.description = option->get_description();
    described.required = option->get_required();
    list.push_back(std::move(described));
  }
  return list;
}

ProgramDescription describe_program(const CLI::App& app) {
  ProgramDescription program{.name = app.get_name(),
                             .description = app.get_description(),
                             .version = "isojam " + std::string(version()),
                             .exit_codes = exit_codes(),
                             .options = describe_options(app),
                             .commands = {}};
  for (const auto* command : app.get_subcommands([](const CLI::App*) { return true; })) {
    auto options = describe_options(*command);
    std::erase_if(options, [](const OptionDescription& option) {
      // Leave out --help, because the description of the program has it.
      return !option.names.empty() && option.names.back() == "--help";
    });
    program.commands.push_back({command->get_name(), command->get_description(), std::move(options)});
  }
  return program;
}

/// Returns an error text for an option without its value, or with several. Returns an empty text for any other error.
std::string wrong_count(const CLI::App& app, const CLI::ParseError& error) {
  if (dynamic_cast<const CLI::ArgumentMismatch*>(&error) == nullptr) return "";
  const std::string text = error.what();
  const auto name = text.substr(0, text.find(':'));
  const auto given = app.get_subcommands();
  std::vector<const CLI::App*> owners(given.begin(), given.end());
  owners.push_back(&app);
  for (const auto* owner : owners) {
    const auto* option = owner->get_option_no_throw(name);
    if (option == nullptr || option->get_items_expected_max() == 0) continue;
    if (option->count() > 1) return fmt::format("{} is given {} times; give it once", name, option->count());
    return fmt::format("{} needs a value{}", name, expected_value(option->get_type_name()));
  }
  return "";
}

/// Returns the error text in the terms of the program. Returns an empty text for an error whose text is already in
/// these terms, and for a request of the help or the version.
std::string own_text(const CLI::App& app, const CLI::ParseError& error) {
  if (error.get_exit_code() == 0) return "";
  if (auto text = unexpected_argument(app); !text.empty()) return text;
  if (dynamic_cast<const CLI::RequiredError*>(&error) != nullptr) return missing_argument(app);
  return wrong_count(app, error);
}

std::string not_accepted(const std::string& text, const std::string& allowed) {
  return "\"" + text + "\" is not accepted; expected " + allowed;
}

/// Returns an error text if the number is not positive or not finite, and otherwise an empty text.
std::string not_positive(const std::string& text) {
  double value = 0;
  const bool good = CLI::detail::lexical_cast(text, value) && value > 0 && std::isfinite(value);
  return good ? "" : not_accepted(text, "a positive number");
}

}  // namespace

void Options::text(const std::string& name, std::string& value, const std::string& description, const std::string& type,
                   Need need) {
  const auto not_empty = [](const std::string& text) {
    return text.empty() ? std::string("the text is empty; give a value, or leave the option out") : std::string();
  };
  app_.add_option(name, value, description)->check(not_empty)->required(need == Need::required)->type_name(type);
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
                     std::function<void()> when_absent, const std::string& description, const std::string& type) {
  const auto parse = [name, read](const std::string& text) {
    if (const auto problem = read(text)) throw CLI::ValidationError(name, *problem);
  };
  const auto* option = app_.add_option_function<std::string>(name, parse, description)->type_name(type);
  app_.parse_complete_callback([option, when_absent = std::move(when_absent)] {
    if (option->count() == 0) when_absent();
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

void Options::results_directory(std::string& directory) {
  text("directory", directory, "Directory with the results of isojam run", "DIR", Need::required);
}

void Options::threads(int& threads) {
  constexpr int most_threads = 4096;
  app_.add_option("-j,--threads", threads, "Number of threads (default: all that the system allows this process)")
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
  CLI::App app("isojam computes and analyses jammed packings of soft, frictionless convex polyhedra", "isojam");
  app.require_subcommand(1);
  app.fallthrough();
  app.set_version_flag("--version", version_text());
  app.footer(help_footer());  // of all commands
  add_console_options(Options(app), session.console);
  for (const AddCommand add : commands) add(app, session);
  app.footer(examples + help_footer());
  session.program = describe_program(app);
  try {
    app.parse(argc, argv);
  } catch (const std::invalid_argument& error) {
    std::fprintf(stderr, "isojam: error: %s\n", printable(error.what()).c_str());
    return ExitCode::usage;
  } catch (const CLI::ParseError& error) {
    if (const auto text = own_text(app, error); !text.empty()) {
      std::fprintf(stderr, "isojam: error: %s\n", printable(text).c_str());
      return ExitCode::usage;
    }
    std::ostringstream out, err;
    const bool asked = app.exit(error, out, err) == 0;
    print(out.str());
    if (!asked) std::fprintf(stderr, "isojam: error: %s\n", printable(error.what()).c_str());
    return asked ? ExitCode::done : ExitCode::usage;
  }
  return std::nullopt;
}

}  // namespace isojam
