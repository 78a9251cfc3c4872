#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <optional>
#include <string>
#include <vector>

#include "tasks/commands/command.hpp"
#include "tasks/io/atomic_file.hpp"
#include "tasks/io/place.hpp"
#include "tasks/io/sealed.hpp"
#include "tasks/io/standard_streams.hpp"
#include "tasks/manifest/base.hpp"
#include "tasks/tables/table_of.hpp"
#include "tasks/tables/tables.hpp"

namespace isojam {

enum class TableFormat { text, json, csv, csv_long, latex };
template <>
inline constexpr std::array enum_names<TableFormat>{
    EnumName{TableFormat::text, "text"}, EnumName{TableFormat::json, "json"}, EnumName{TableFormat::csv, "csv"},
    EnumName{TableFormat::csv_long, "csv-long"}, EnumName{TableFormat::latex, "latex"}};

namespace {

constexpr std::size_t most_columns = 100'000;

struct AggregateArguments {
  std::vector<std::string> directories;
  std::string output;  ///< path of tables.json to write; empty: none
  TableFormat format = TableFormat::text;
  bool series = false;                 ///< print the quantities of all states; otherwise those of the nearest state
  bool all = false;                    ///< print all tables
  std::optional<std::size_t> columns;  ///< --columns; nullopt: the width of the terminal
  TableChoices choices;
};

std::string formatted(const Table& table, TableFormat format, View view, const TextOptions& text) {
  switch (format) {
    case TableFormat::json: return sealed(to_json(table));
    case TableFormat::csv: return to_csv(table, view);
    case TableFormat::csv_long: return to_long_csv(table, view);
    case TableFormat::latex: return to_latex(table, view);
    case TableFormat::text: break;
  }
  return to_text(table, view, text);
}

/// Parses "none", or names of flags separated by commas. Returns an error text if a name is unknown.
std::optional<std::string> read_exclude(const std::string& text, std::optional<std::vector<Flag>>& exclude) {
  std::vector<Flag> flags;
  for (std::size_t from = 0; text != "none" && from <= text.size();) {
    const auto to = std::min(text.find(',', from), text.size());
    const auto name = text.substr(from, to - from);
    if (name == "none") return "\"none\" is not accepted in a list; expected \"none\" alone, or names of flags";
    const auto flag = from_string<Flag>(name);
    if (!flag) return unknown_name("flag", name, all_names<Flag>, "\"none\" or ");
    if (std::find(flags.begin(), flags.end(), *flag) == flags.end()) flags.push_back(*flag);
    from = to + 1;
  }
  std::sort(flags.begin(), flags.end());
  exclude = std::move(flags);
  return std::nullopt;
}

/// Parses a number of columns; returns an error text if this fails.
std::optional<std::string> read_columns(const std::string& text, std::optional<std::size_t>& columns) {
  std::size_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || value > most_columns)
    return fmt::format("\"{}\" is not accepted; expected an integer from 0 to {}", text, most_columns);
  columns = value;
  return std::nullopt;
}

/// Prints the tables. Writes no file except the one that --output names.
ExitCode print_tables(const AggregateArguments& arguments, Console& console) {
  const Warn warn = [&](const std::string& message) { console.warn(message); };
  auto choices = arguments.choices;
  choices.series = arguments.series || arguments.format == TableFormat::json || !arguments.output.empty();
  const auto table = table_of(arguments.directories, warn, choices);
  // A base on the command line must match a row. A base of the manifest may belong to a row whose replicates have not
  // run yet.
  if (const auto problem = arguments.choices.base ? misplaced_base(table) : std::nullopt) {
    console.error(*problem);
    return ExitCode::usage;
  }
  if (!arguments.output.empty()) write_output(arguments.output, sealed(to_json(table)));
  const TextOptions text{arguments.all, arguments.columns.value_or(output_columns()), "The option --all", {}};
  print(formatted(table, arguments.format, arguments.series ? View::series : View::nearest, text));
  return ExitCode::done;
}

}  // namespace

void add_aggregate(CLI::App& app, Session& session) {
  AggregateArguments* arguments = nullptr;
  auto options = add_command(app, session, "aggregate", "Print tables of the records in results directories",
                             print_tables, arguments);
  options.texts("directories", arguments->directories, "Results directories", "DIR");
  options.text("-o,--output", arguments->output, "Also write the tables to this file, as JSON", "FILE");
  options.choice("--format", arguments->format, "Print the tables in this format");
  options.flag("--all", arguments->all, "Print all tables as text, not only the first one");
  options.parsed(
      "--columns", [arguments](const std::string& text) { return read_columns(text, arguments->columns); }, [] {},
      "Width of the tables as text (default: the width of the terminal; 0: no limit)", "N");
  options.parsed(
      "--exclude", [arguments](const std::string& text) { return read_exclude(text, arguments->choices.exclude); },
      [] {},
      "Exclude replicates with these flags from the means. Separate flags by commas; the word none keeps all "
      "replicates "
      "(default: the flags of the manifest)",
      "FLAGS");
  options.parsed(
      "--base", [arguments](const std::string& text) { return parse_base(text, arguments->choices.base.emplace()); },
      [] {},
      "Print differences from the row with these values of swept parameters, for example "
      "step_fraction=0.35,method=newton; the word none prints no "
      "differences (default: the base of the manifest)",
      "PARAMETER=VALUE");
  options.flag("--series", arguments->series,
               "Print the quantities of all states as functions of the distance to jamming, instead of those of the "
               "state nearest jamming (the format json always contains both)");
}

}  // namespace isojam
