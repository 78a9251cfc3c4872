#include "tasks/io/fields.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace isojam {
namespace {

/// A member without optional and Reasoned around it.
struct Core {
  MemberRef member;
  bool nullable = false, optional = false;
};
Core core_of(const FieldEntry& field) {
  Core core{field.member};
  for (auto stars = std::count(field.key.begin(), field.key.end(), '*'); stars > 0; --stars) {
    MemberRef element = std::get<Many>(core.member).example();
    core.member = std::move(element);
    core.optional = true;
  }
  while (const auto* const maybe = std::get_if<Maybe>(&core.member)) {
    (maybe->reason ? core.nullable : core.optional) = true;
    MemberRef inner = maybe->example();
    core.member = std::move(inner);
  }
  if (const auto* const custom = std::get_if<Custom>(&core.member); custom && custom->fields) {
    MemberRef inner = Nested{custom->fields};
    core.member = std::move(inner);
  }
  core.nullable = core.nullable || (std::holds_alternative<double*>(core.member) && !field.finite_only);
  core.optional = core.optional || field.presence != Presence::always;
  return core;
}

/// The innermost elements of a list, or the value itself.
MemberRef element_of(const MemberRef& member) {
  MemberRef element = member;
  while (const auto* const list = std::get_if<Many>(&element)) {
    MemberRef inner = list->example();
    element = std::move(inner);
  }
  return element;
}

std::optional<Fields> fields_in(const MemberRef& member) {
  const MemberRef element = element_of(member);
  const auto* const object = std::get_if<Nested>(&element);
  if (!object) return std::nullopt;
  Fields fields;
  object->describe(fields);
  return fields;
}

// ---- Schemas --------------------------------------------------------------------------------------------------------
Json exact(double value) {
  if (std::floor(value) == value && std::abs(value) <= count_range.high) return static_cast<std::int64_t>(value);
  return value;
}

Json number_schema(const FieldEntry& field, const Integer* integer) {
  Json json{{"type", integer ? "integer" : "number"}};
  const auto range = field.allowed.value_or(integer ? count_range : any_number);
  if (range.low > any_number.low) json[range.low_excluded ? "exclusiveMinimum" : "minimum"] = exact(range.low);
  if (field.allowed && range.high < any_number.high)
    json[range.high_excluded ? "exclusiveMaximum" : "maximum"] =
        exact(integer ? std::min(range.high, integer->most) : range.high);
  return json;
}

Json object_schema(const Fields& fields, Json& definitions);

/// Moves the definitions in a schema, and in the schemas inside it, to those of the document.
void move_definitions(Json& schema, Json& definitions) {
  if (!schema.is_structured()) return;
  for (auto& part : schema) move_definitions(part, definitions);
  if (!schema.is_object() || !schema.contains("definitions")) return;
  definitions.update(schema.at("definitions"));
  schema.erase("definitions");
}

/// The value that an optional field has if a file lacks it. null if the field is an object or a file cannot state it.
Json initial_value(const FieldEntry& field) {
  if (field.presence != Presence::optional || std::holds_alternative<Nested>(core_of(field).member)) return nullptr;
  auto value = written(field);
  if (value.is_number() && field.allowed && !field.allowed->contains(value.get<double>())) return nullptr;
  return value;
}

Json or_null(Json value) {
  if (!value.contains("type") || !value.at("type").is_string())
    return {{"anyOf", {std::move(value), {{"type", "null"}}}}};
  value["type"] = {value.at("type"), "null"};
  return value;
}

Json value_schema(const FieldEntry& field, const MemberRef& member, Json& definitions) {
  if (const auto* const maybe = std::get_if<Maybe>(&member))
    return or_null(value_schema(field, maybe->example(), definitions));
  if (const auto* const list = std::get_if<Many>(&member)) {
    Json json{{"type", "array"}, {"items", value_schema(field, list->example(), definitions)}};
    if (list->least > 0) json["minItems"] = list->least;
    if (list->most < std::numeric_limits<std::size_t>::max()) json["maxItems"] = list->most;
    if (list->all_different) json["uniqueItems"] = true;
    return json;
  }
  if (const auto* const object = std::get_if<Nested>(&member)) {
    Fields fields;
    object->describe(fields);
    if (fields.type_name.empty()) return object_schema(fields, definitions);
    if (!definitions.contains(fields.type_name)) {
      Json& definition = definitions[fields.type_name];
      definition["description"] = fields.type_meaning;
      auto inner = object_schema(fields, definitions);
      definitions[fields.type_name].update(inner);
    }
    return {{"$ref", std::string("#/definitions/").append(fields.type_name)}};
  }
  if (const auto* const choice = std::get_if<Choice>(&member)) return {{"enum", choice->names}};
  if (const auto* const custom = std::get_if<Custom>(&member)) {
    auto json = custom->schema;
    move_definitions(json, definitions);
    return json;
  }
  if (std::holds_alternative<std::string*>(member)) return {{"type", "string"}};
  if (std::holds_alternative<bool*>(member))
    return field.presence == Presence::if_true ? Json{{"const", true}} : Json{{"type", "boolean"}};
  return number_schema(field, std::get_if<Integer>(&member));
}

Json field_schema(const FieldEntry& field, const Core& core, Json& definitions) {
  Json json = Json::object();
  if (!field.meaning.empty()) json["description"] = field.meaning;
  auto value = value_schema(field, core.member, definitions);
  if (core.nullable) value = or_null(std::move(value));
  // Beside $ref, draft-07 ignores all other keys.
  if (value.contains("$ref") && !field.meaning.empty()) value = {{"allOf", Json::array({std::move(value)})}};
  json.update(value);
  if (const auto initial = initial_value(field); !initial.is_null()) json["default"] = initial;
  return json;
}

Json object_schema(const Fields& fields, Json& definitions) {
  Json json{{"type", "object"}}, properties = Json::object(), required = Json::array();
  for (const auto& field : fields.list) {
    const auto core = core_of(field);
    if (field.key.find('*') != std::string::npos) {
      std::string pattern;
      for (const char c : field.key) pattern += c == '*' ? "[1-9][0-9]*" : std::string(1, c);
      json["patternProperties"]["^" + pattern + "$"] = field_schema(field, core, definitions);
      continue;
    }
    properties[field.key] = field_schema(field, core, definitions);
    if (!core.optional) required.push_back(field.key);
    if (!core.nullable) continue;
    definitions["reason"] = {{"description", "Reason why a value is null: that of the key without `_reason`."},
                             {"type", "string"},
                             {"minLength", 1}};
    properties[std::string(field.key) + "_reason"] = {{"$ref", "#/definitions/reason"}};
  }
  if (!required.empty()) json["required"] = std::move(required);
  json["additionalProperties"] = false;
  if (!fields.rules.is_null()) json.update(fields.rules);
  json["properties"] = std::move(properties);
  return json;
}

// ---- Lists for people -----------------------------------------------------------------------------------------------
std::string bounds(const Json& value) {
  constexpr std::array signs{std::pair{"minimum", "≥"}, std::pair{"exclusiveMinimum", ">"}, std::pair{"maximum", "≤"},
                             std::pair{"exclusiveMaximum", "<"}};
  std::string text;
  for (const auto& [key, sign] : signs) {
    if (value.contains(key)) text += fmt::format("{} {} {}", text.empty() ? "" : ",", sign, value.at(key).dump());
  }
  return text;
}

std::string scalar_kind(const FieldEntry& field, const MemberRef& member) {
  if (const auto* const custom = std::get_if<Custom>(&member)) return custom->kind;
  if (const auto* const choice = std::get_if<Choice>(&member)) {
    std::string text;
    for (std::size_t k = 0; k < choice->names.size(); ++k)
      text += fmt::format("{}`{}`", k == 0 ? "" : k + 1 == choice->names.size() ? " or " : ", ", choice->names[k]);
    return text;
  }
  if (std::holds_alternative<std::string*>(member)) return "text";
  if (std::holds_alternative<bool*>(member))
    return field.presence == Presence::if_true ? "`true`" : "`true` or `false`";
  const auto* const integer = std::get_if<Integer>(&member);
  return (integer ? "integer" : "number") + bounds(number_schema(field, integer));
}

void add_sections(const Fields& fields, const std::string& path, std::vector<FieldSection>& sections,
                  std::set<std::string>& types) {
  const auto title = fields.type_name.empty() ? path : std::string(fields.type_name);
  if (!fields.type_name.empty() && !types.insert(title).second) return;
  const auto place = sections.size();
  sections.push_back({title, fields.type_meaning, {}});
  for (const auto& field : fields.list) {
    const auto core = core_of(field);
    const bool is_list = std::holds_alternative<Many>(core.member);
    FieldRow row{field.key, "", field.unit_name, field.meaning, ""};
    if (const auto inner = fields_in(core.member)) {
      const auto below = (path.empty() ? "" : path + ".").append(field.key);
      row.inner = inner->type_name.empty() ? below : std::string(inner->type_name);
      row.kind = is_list ? "list of objects" : "object";
      add_sections(*inner, below, sections, types);
    } else {
      row.kind = (is_list ? "list: " : "") + scalar_kind(field, element_of(core.member));
    }
    if (core.nullable) row.kind += " or null";
    if (core.optional && field.presence == Presence::always) row.kind += ", optional";
    if (field.presence == Presence::optional) {
      const auto initial = initial_value(field);
      row.kind += initial.is_null() ? ", optional" : fmt::format(", default {}", initial.dump());
    }
    sections[place].rows.push_back(std::move(row));
  }
}

}  // namespace

Json schema_of(const Fields& fields, std::string_view title) {
  Json json{{"$schema", "http://json-schema.org/draft-07/schema#"}, {"title", title}}, definitions = Json::object();
  if (!fields.type_meaning.empty()) json["description"] = fields.type_meaning;
  json.update(object_schema(fields, definitions));
  if (!definitions.empty()) json["definitions"] = std::move(definitions);
  return json;
}

Json object_schema(const Fields& fields) {
  Json definitions = Json::object();
  auto json = object_schema(fields, definitions);
  if (!definitions.empty()) json["definitions"] = std::move(definitions);
  return json;
}

std::vector<FieldSection> sections_of(const Fields& fields, const std::string& title) {
  std::vector<FieldSection> sections;
  std::set<std::string> types;
  add_sections(fields, title, sections, types);
  return sections;
}

namespace {

/// Columns of a field whose key has a star. Tables have them for the first four kinds of particles.
void add_numbered(const FieldEntry& field, const std::string& pointer, std::vector<FlatColumn>& columns) {
  const auto put_number = [](Column& column, std::size_t number) {
    if (column.name.empty()) return;
    column.name = numbered(column.name, number);
    column.latex = numbered(column.latex, number);
    column.meaning = numbered(column.meaning, number);
    column.kinds = std::max(column.kinds, static_cast<int>(number));
  };
  for (std::size_t number = 1; number <= 4; ++number) {
    FieldEntry one = field;
    one.key = numbered(field.key, number);
    one.member = std::get<Many>(field.member).example();
    put_number(one.quantity, number);
    for (auto& column : columns_of(Fields{"", "", {one}}, pointer)) {
      column.can_be_absent = true;
      if (column.field.quantity.name.find('*') != std::string::npos) {
        put_number(column.field.quantity, number);
        column.name = column.field.quantity.name;
      }
      columns.push_back(std::move(column));
    }
  }
}

}  // namespace

std::vector<FlatColumn> columns_of(const Fields& fields, const std::string& pointer) {
  std::vector<FlatColumn> columns;
  for (const auto& field : fields.list) {
    if (field.key.find('*') != std::string::npos) {
      add_numbered(field, pointer, columns);
      continue;
    }
    const auto core = core_of(field);
    const auto below = pointer + pointer_step(field.key);
    if (std::holds_alternative<Many>(core.member) || std::holds_alternative<Custom>(core.member)) continue;
    if (const auto inner = fields_in(core.member)) {
      for (auto& column : columns_of(*inner, below)) {
        column.can_be_absent = column.can_be_absent || core.optional;
        columns.push_back(std::move(column));
      }
      continue;
    }
    std::string name(field.quantity.name);
    if (name.empty()) {
      name = below.substr(1);
      std::replace(name.begin(), name.end(), '/', '.');
    }
    columns.push_back({std::move(name), below, field, core.optional});
  }
  return columns;
}

bool is_text(const FieldEntry& field) {
  const auto core = core_of(field);
  return std::holds_alternative<std::string*>(core.member) || std::holds_alternative<Choice>(core.member);
}

}  // namespace isojam
