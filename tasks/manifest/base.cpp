#include "tasks/manifest/base.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <string_view>
#include <type_traits>
#include <variant>

#include "tasks/manifest/fields.hpp"

namespace isojam {
namespace {

std::vector<std::string_view> field_names() {
  std::vector<std::string_view> names;
  for (const auto& field : all_fields()) names.push_back(field.name);
  return names;
}

Json read_value(const JsonPlace& place, const Field& field) {
  JamOptions options;
  read_field(place, field, options);
  return field_value(field, options);
}

/// Values as a JSON object, sorted by name like the parameters of a sweep point.
Json object_of(const std::map<std::string, Json>& values) {
  Json base = Json::object();
  for (const auto& [name, value] : values) base[name] = value;
  return base;
}

void check_value(const JsonPlace& place, const Json& value, const SweptField& swept) {
  if (std::find(swept.values.begin(), swept.values.end(), value) != swept.values.end()) return;
  std::string allowed;
  for (const auto& each : swept.values) allowed += (allowed.empty() ? "" : ", ") + compact(each);
  place.refuse(fmt::format("{} is not a swept value", compact(value)), "one of " + allowed);
}

void check_parameter(const JsonPlace& place, const std::string& name, const Json& value,
                     const std::vector<SweptField>& swept) {
  const auto found = std::find_if(swept.begin(), swept.end(), [&](const SweptField& s) { return s.name == name; });
  if (found != swept.end()) return check_value(place, value, *found);
  std::vector<std::string_view> names;
  for (const auto& each : swept) names.push_back(each.name);
  constexpr auto problem = "the parameter is not swept";
  if (names.empty()) place.refuse_with_remedy(problem, fmt::format("remove the base, or add {} to /sweep", name));
  place.refuse(problem, one_of(names), nearest_name(name, names));
}

/// Value of a parameter from its text on the command line.
Json value_of(const std::string& word, const Field& field) {
  JamOptions options;
  const Slot slot = field.slot(options);
  if (std::visit([]<class T>(const T*) { return std::is_enum_v<T>; }, slot)) return word;
  auto value = Json::parse(word, nullptr, false);
  return value.is_discarded() ? Json(word) : value;
}

std::string unknown_parameter(const std::string& name) {
  const auto names = field_names();
  return unknown_name("parameter", name, names, "\"none\" or ");
}

/// Parses one "parameter=value". Returns an error text if this fails.
std::optional<std::string> parse_part(const std::string& part, std::map<std::string, Json>& values) {
  const auto equals = part.find('=');
  if (equals == std::string::npos)
    return fmt::format("\"{}\" has no value; expected \"none\", or PARAMETER=VALUE separated by commas", part);
  const auto name = part.substr(0, equals);
  const auto* field = find_field(name);
  if (!field) return unknown_parameter(name);
  const auto value = value_of(part.substr(equals + 1), *field);
  try {
    if (!values.emplace(name, read_value({value, name}, *field)).second)
      return fmt::format("\"{}\" is given twice; give each parameter once", name);
  } catch (const InputError& error) {
    return one_line(error.details());
  }
  return std::nullopt;
}

}  // namespace

Json read_base(const JsonPlace& place) {
  const auto names = field_names();
  refuse_removed(place);
  place.expect_keys(names);
  if (place.value().empty()) place.refuse("the base is empty", "one or more swept parameters with their values");
  std::map<std::string, Json> values;
  for (const auto name : names) {
    const std::string key(name);
    place.read_if_any(key, [&](const JsonPlace& value) { values[key] = read_value(value, *find_field(key)); });
  }
  return object_of(values);
}

void check_base(const JsonPlace& place, const Json& base, const std::vector<SweptField>& swept) {
  for (const auto& item : base.items()) {
    const auto& name = item.key();
    place.read(name, [&](const JsonPlace& value) { check_parameter(value, name, item.value(), swept); });
  }
}

std::optional<std::string> parse_base(const std::string& text, Json& base) {
  std::map<std::string, Json> values;
  for (std::size_t from = 0; text != "none" && from <= text.size();) {
    const auto to = std::min(text.find(',', from), text.size());
    if (auto problem = parse_part(text.substr(from, to - from), values)) return problem;
    from = to + 1;
  }
  base = object_of(values);
  return std::nullopt;
}

std::string base_text(const Json& base) {
  std::string text;
  for (const auto& item : base.items()) {
    const auto& value = item.value();
    text += fmt::format("{}{} = {}", text.empty() ? "" : ", ", item.key(),
                        value.is_string() ? value.get<std::string>() : compact(value));
  }
  return text;
}

}  // namespace isojam
