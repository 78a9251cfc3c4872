#include "tasks/commands/shared.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "tasks/commands/command.hpp"
#include "tasks/io/atomic_file.hpp"
#include "tasks/io/fields.hpp"
#include "tasks/io/standard_streams.hpp"
#include "tasks/io/usage_error.hpp"
#include "tasks/manifest/manifest.hpp"
#include "tasks/measure/quantity.hpp"
#include "tasks/records/document.hpp"
#include "tasks/records/state_file.hpp"
#include "tasks/tables/fitted.hpp"
#include "tasks/tables/tables.hpp"

namespace isojam {
namespace {

constexpr std::size_t columns = 100;

const DocumentKind& document(const std::string& name) {
  std::vector<std::string_view> names;
  for (const auto& kind : documents()) {
    if (kind.name == name) return kind;
    names.push_back(kind.name);
  }
  throw UsageError(unknown_name("document", name, names));
}

// ---- schema ---------------------------------------------------------------------------------------------------------
struct SchemaArguments {
  std::string name, output;
};

ExitCode print_schema(const SchemaArguments& arguments, Console&) {
  const auto& kind = document(arguments.name);
  const auto text = pretty(schema_of(kind.fields(), kind.title));
  arguments.output.empty() ? print(text) : write_output(arguments.output, text);
  return ExitCode::done;
}

// ---- fields ---------------------------------------------------------------------------------------------------------
struct FieldsArguments {
  std::string name;
  bool markdown = false;
};

std::string with_unit(const FieldRow& row) {
  return row.kind + (row.unit.empty() || row.unit == "1" ? "" : "; unit: " + row.unit);
}

std::string indented(const std::string& text, std::size_t indent) {
  std::string result;
  const std::string margin(indent, ' ');
  std::string_view rest = text;
  while (!rest.empty()) {
    const auto end = std::min(rest.find('\n'), rest.size());
    result += margin + std::string(rest.substr(0, end)) + '\n';
    rest.remove_prefix(std::min(end + 1, rest.size()));
  }
  return result;
}

std::string text_of(const FieldRow& row, const std::string& name) {
  std::string text = fmt::format("  {} ({})\n", name, with_unit(row));
  text += indented(wrapped(row.meaning, columns - 6), 6);
  if (!row.inner.empty()) text += "      fields: see " + row.inner + "\n";
  return text;
}

std::string text_of(const FieldSection& section) {
  std::string text = section.title + "\n";
  if (!section.meaning.empty()) text += indented(wrapped(section.meaning, columns - 2), 2);
  for (const auto& row : section.rows) text += text_of(row, row.key);
  return text + "\n";
}

std::string escaped(std::string_view text) {
  std::string cell;
  for (const char c : text) cell += c == '|' ? "\\|" : std::string(1, c);
  return cell;
}

std::string markdown_of(const FieldSection& section) {
  std::string text = fmt::format("### {}\n\n", section.title);
  if (!section.meaning.empty()) text += section.meaning + "\n\n";
  text += "| field | value | meaning |\n| --- | --- | --- |\n";
  for (const auto& row : section.rows) {
    const auto see = row.inner.empty() ? "" : fmt::format(" Its fields are under {}.", row.inner);
    text += fmt::format("| `{}` | {} | {}{} |\n", row.key, escaped(with_unit(row)), escaped(row.meaning), see);
  }
  return text + "\n";
}

/// Quantities of tables, with the meaning of their field.
std::string quantities_text(bool markdown) {
  std::string text = markdown ? "## Quantities of tables\n\n| quantity | table | unit | meaning |\n| --- | --- | --- | "
                                "--- |\n"
                              : "quantities of tables\n";
  for (const auto& quantity : all_quantities()) {
    if (markdown) {
      text += fmt::format("| `{}` | {} | {} | {} |\n", quantity.name, quantity.group.name, quantity.unit,
                          escaped(quantity.meaning));
    } else {
      text += fmt::format("  {} ({}; {})\n", quantity.name, quantity.group.name, quantity.unit);
      text += indented(wrapped(quantity.meaning, columns - 6), 6);
    }
  }
  return text + "\n";
}

std::string document_text(const DocumentKind& kind, bool markdown) {
  std::string text = markdown ? fmt::format("## {}\n\n", kind.title) : "";
  for (const auto& section : sections_of(kind.fields(), std::string(kind.name)))
    text += markdown ? markdown_of(section) : text_of(section);
  return text;
}

/// All fields with this key, and the quantity with this name.
std::string fields_named(const std::string& name) {
  std::string text;
  for (const auto& quantity : all_quantities()) {
    if (quantity.name != name) continue;
    text += fmt::format("quantity {} ({}; {}), {} of records\n", name, quantity.group.name, quantity.unit,
                        quantity.pointer);
    text += indented(wrapped(quantity.meaning, columns - 6), 6);
  }
  for (const auto& kind : documents()) {
    for (const auto& section : sections_of(kind.fields(), std::string(kind.name))) {
      for (const auto& row : section.rows) {
        if (row.key == name) text += text_of(row, section.title + "." + row.key);
      }
    }
  }
  return text;
}

/// The error for a name that is neither a document nor a field.
[[noreturn]] void refuse(const std::string& name) {
  std::vector<std::string> all;
  for (const auto& kind : documents()) {
    all.emplace_back(kind.name);
    for (const auto& section : sections_of(kind.fields(), std::string(kind.name))) {
      for (const auto& row : section.rows) all.push_back(row.key);
    }
  }
  for (const auto& quantity : all_quantities()) all.emplace_back(quantity.name);
  const std::vector<std::string_view> names(all.begin(), all.end());
  const auto nearest = nearest_name(name, names);
  throw UsageError(fmt::format("no document, field or quantity has the name \"{}\"; {}", name,
                               nearest.empty() ? std::string("\"isojam fields\" lists all quantities")
                                               : fmt::format("did you mean \"{}\"?", nearest)));
}

ExitCode print_fields(const FieldsArguments& arguments, Console&) {
  std::string text;
  for (const auto& kind : documents()) {
    if (arguments.name == kind.name || (arguments.name.empty() && arguments.markdown))
      text += document_text(kind, arguments.markdown);
  }
  if (arguments.name.empty()) text = quantities_text(arguments.markdown) + text;
  if (text.empty()) text = fields_named(arguments.name);
  if (text.empty()) refuse(arguments.name);
  print(text);
  return ExitCode::done;
}

std::string document_names() {
  std::string names;
  for (const auto& kind : documents()) names += (names.empty() ? "" : ", ") + std::string(kind.name);
  return names;
}

}  // namespace

std::vector<DocumentKind>& documents() {
  static std::vector<DocumentKind> all{{"manifest", "isojam manifest", fields_of<Manifest>},
                                       {"record", "isojam record", fields_of<Record>},
                                       {"packing", "isojam packing", fields_of<PackingFile>},
                                       {"path", "isojam path", fields_of<PathFile>},
                                       {"tables", "isojam tables", fields_of<Table>}};
  return all;
}

void add_schema(CLI::App& app, Session& session) {
  SchemaArguments* arguments = nullptr;
  auto options =
      add_command(app, session, "schema", "Print the JSON schema of a kind of file", print_schema, arguments);
  options.text("name", arguments->name, "Kind of file: " + document_names(), "NAME", Options::Need::required);
  options.text("-o,--output", arguments->output, "Output file (default: standard output)", "FILE");
}

void add_fields(CLI::App& app, Session& session) {
  FieldsArguments* arguments = nullptr;
  auto options = add_command(app, session, "fields", "Explain the quantities of tables and the fields of files",
                             print_fields, arguments);
  options.text(
      "name", arguments->name,
      "Kind of file (" + document_names() + "), key of a field, or name of a quantity (default: all quantities)",
      "NAME");
  options.flag("--markdown", arguments->markdown, "Print tables in Markdown; without NAME, of all files");
}

}  // namespace isojam
