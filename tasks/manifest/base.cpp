#include "tasks/manifest/base.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <string_view>
#include <variant>

namespace isojam {
namespace {

std::vector<std::string_view> parameter_names() {
  std::vector<std::string_view> names;
  for (const auto& parameter : all_parameters()) names.push_back(parameter.name);
  return names;
}

void check_value(const JsonPlace& place, const Json& value, const std::vector<Json>& swept) {
  if (std::find(swept.begin(), swept.end(), value) != swept.end()) return;
  std::string allowed;
  for (const auto& each : swept) allowed += (allowed.empty() ? "" : ", ") + compact(each);
  place.refuse(fmt::format("{} is not a swept value", compact(value)), "one of " + allowed);
}

void check_parameter(const JsonPlace& place, const std::string& name, const Json& value, const SweptValues& swept) {
  if (const auto found = swept.find(name); found != swept.end()) return check_value(place, value, found->second);
  std::vector<std::string_view> names;
  for (const auto& each : swept) names.push_back(each.first);
  constexpr auto problem = "the parameter is not swept";
  if (names.empty()) place.refuse_with_remedy(problem, fmt::format("remove the base, or add {} to /sweep", name));
  place.refuse(problem, one_of(names), nearest_name(name, names));
}

/// Value of a parameter from its text on the command line.
Json value_of(const std::string& word, const Parameter& parameter) {
  if (std::holds_alternative<Choice>(parameter.field.member)) return word;
  auto value = parsed(word, false);
  return value.is_discarded() ? Json(word) : value;
}

std::string unknown_parameter(const std::string& name) {
  JamOptions options;
  for (const auto& [before, now] : flat_fields(options).renamed)
    if (before == name) return fmt::format("unknown parameter \"{}\"; did you mean \"{}\"?", name, now);
  const auto names = parameter_names();
  return unknown_name("parameter", name, names, "\"none\" or ");
}

/// Parses one "parameter=value". Returns an error text if this fails.
std::optional<std::string> parse_part(const std::string& part, std::map<std::string, Json>& values) {
  const auto equals = part.find('=');
  if (equals == std::string::npos)
    return fmt::format("\"{}\" has no value; expected \"none\", or PARAMETER=VALUE separated by commas", part);
  const auto name = part.substr(0, equals);
  const auto* parameter = find_parameter(name);
  if (!parameter) return unknown_parameter(name);
  const auto value = value_of(part.substr(equals + 1), *parameter);
  try {
    JamOptions options;
    read_into({value, name}, parameter_of(options, name).field);
    if (!values.emplace(name, value_of(name, options)).second)
      return fmt::format("\"{}\" is given twice; give each parameter once", name);
  } catch (const InputError& error) {
    return one_line(error.details());
  }
  return std::nullopt;
}

}  // namespace

Json read_base(const JsonPlace& place) {
  OptionSet set;
  read_some(place, flat_fields(set.options), set);
  if (place.value().empty()) place.refuse("the base is empty", "one or more swept parameters with their values");
  std::map<std::string, Json> sorted;
  for (const auto& item : set.parameters.items()) sorted[item.key()] = item.value();
  return sorted;
}

void check_base(const JsonPlace& place, const Json& base, const SweptValues& swept) {
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
  base = Json(values);
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
