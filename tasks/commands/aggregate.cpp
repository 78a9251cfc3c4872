#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include "tasks/commands/command.hpp"
#include "tasks/json/place.hpp"
#include "tasks/json/sealed.hpp"
#include "tasks/manifest/base.hpp"
#include "tasks/system/atomic_file.hpp"
#include "tasks/system/standard_streams.hpp"
#include "tasks/tables/table_of.hpp"
#include "tasks/tables/tables.hpp"

namespace isojam {

enum class TableFormat { text, json, csv, csv_long, latex };
template <>
inline constexpr std::array enum_names<TableFormat>{
    EnumName{TableFormat::text, "text"}, EnumName{TableFormat::json, "json"}, EnumName{TableFormat::csv, "csv"},
    EnumName{TableFormat::csv_long, "csv-long"}, EnumName{TableFormat::latex, "latex"}};

namespace {

struct Arguments {
  std::vector<std::string> directories;
  std::string output;  ///< path of tables.json to write; empty: none
  TableFormat format = TableFormat::text;
  bool series = false;  ///< quantities against Δφ instead of at the state nearest jamming; JSON has both
  TableChoices choices;
};

std::string formatted(const Table& table, TableFormat format, View view) {
  switch (format) {
    case TableFormat::json: return sealed(to_json(table));
    case TableFormat::csv: return to_csv(table, view);
    case TableFormat::csv_long: return to_long_csv(table, view);
    case TableFormat::latex: return to_latex(table, view);
    case TableFormat::text: break;
  }
  return to_text(table, view);
}

/// Parses "none" or comma-separated names of flags; returns an error text if this fails.
std::optional<std::string> read_exclude(const std::string& text, std::optional<std::vector<Flag>>& exclude) {
  std::vector<Flag> flags;
  for (std::size_t from = 0; text != "none" && from <= text.size();) {
    const auto to = std::min(text.find(',', from), text.size());
    const auto name = text.substr(from, to - from);
    const auto flag = from_string<Flag>(name);
    if (!flag) {
      const auto nearest = nearest_name(name, all_names<Flag>);
      return fmt::format("no flag is called \"{}\"; {}", name,
                         nearest.empty() ? "allowed: none, or " + quoted_list(all_names<Flag>)
                                         : fmt::format("did you mean \"{}\"?", nearest));
    }
    if (std::find(flags.begin(), flags.end(), *flag) == flags.end()) flags.push_back(*flag);
    from = to + 1;
  }
  std::sort(flags.begin(), flags.end());
  exclude = std::move(flags);
  return std::nullopt;
}

/// Writes no file except the requested output.
ExitCode aggregate_directories(const Arguments& arguments, Console& console) {
  const Warn warn = [&](const std::string& message) { console.warn(message); };
  const auto table = table_of(arguments.directories, warn, arguments.choices);
  // A base of the command line that matches no row is a typing error. A base of the manifest may match rows that have
  // not run yet.
  if (const auto problem = arguments.choices.base ? misplaced_base(table) : std::nullopt) {
    console.error(*problem);
    return ExitCode::usage;
  }
  if (!arguments.output.empty()) write_output(arguments.output, sealed(to_json(table)));
  print(formatted(table, arguments.format, arguments.series ? View::series : View::nearest));
  return ExitCode::done;
}

}  // namespace

void add_aggregate(CLI::App& app, Session& session) {
  Arguments* arguments = nullptr;
  auto options = add_command(app, session, "aggregate", "Make a table of the records in results directories",
                             aggregate_directories, arguments);
  options.texts("directories", arguments->directories, "Results directories", "DIR");
  options.text("-o,--output", arguments->output, "Write the table as JSON to this file as well", "FILE");
  options.choice("--format", arguments->format, "Format on stdout");
  options.parsed(
      "--exclude", [arguments](const std::string& text) { return read_exclude(text, arguments->choices.exclude); },
      [] {},
      "Leave replicates with these flags, between commas, out of the means, or none (default: as the manifest says)",
      "FLAGS");
  options.parsed(
      "--base", [arguments](const std::string& text) { return parse_base(text, arguments->choices.base.emplace()); },
      [] {},
      "Give the differences of rows from the one with these swept values, as step_fraction=0.35, several between "
      "commas, or none (default: as the manifest says)",
      "PARAMETER=VALUE");
  options.flag("--series", arguments->series, "Quantities against the distance above jamming (JSON has both)");
}

}  // namespace isojam
