#include "tasks/io/rows.hpp"

#include <cassert>

namespace isojam {
namespace {

std::string csv_text(const Json& value) {
  if (value.is_null()) return "";
  return value.is_string() ? csv_field(value.get_ref<const std::string&>()) : compact(value);
}

}  // namespace

std::string csv_field(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? "\"\"" : std::string(1, c);
  return quoted + '"';
}

std::string head_line(RowFormat format, const Columns& columns) {
  if (format == RowFormat::json_lines) return "";
  std::string line;
  for (const auto& name : columns) line += (line.empty() ? "" : ",") + csv_field(name);
  return line + '\n';
}

std::string row_line(RowFormat format, const Columns& columns, const std::vector<Json>& values) {
  assert(values.size() == columns.size());
  std::string line;
  if (format == RowFormat::csv) {
    for (std::size_t k = 0; k < values.size(); ++k) {
      if (k > 0) line += ',';
      line += csv_text(values[k]);
    }
    return line + '\n';
  }
  Json object;
  for (std::size_t k = 0; k < values.size(); ++k) object[columns[k]] = values[k];
  return compact(object) + '\n';
}

}  // namespace isojam
