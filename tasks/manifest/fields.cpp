#include "tasks/manifest/fields.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <type_traits>
#include <vector>

#include "tasks/io/options.hpp"

namespace isojam {
namespace {

constexpr Range positive_to(double high) { return {0, high, true, false}; }
constexpr Range none{};

template <class Value, class Struct>
auto& holder(JamOptions& options, Value Struct::*) {
  if constexpr (std::is_same_v<Struct, Compression>) {
    return options.compression;
  } else if constexpr (std::is_same_v<Struct, Decompression>) {
    return options.decompression;
  } else if constexpr (std::is_same_v<Struct, MinimiseOptions>) {
    return options.minimise;
  } else if constexpr (std::is_same_v<Struct, Cohesion>) {
    return options.cohesion;
  } else {
    return options;
  }
}

template <auto member>
constexpr Field field(std::string_view name, Range range, Group group = Group::protocol) {
  return {name, group, [](JamOptions& options) -> Slot { return &(holder(options, member).*member); }, range};
}

using C = Compression;
using D = Decompression;
using P = JamOptions;
using M = MinimiseOptions;

constexpr std::array fields{
    field<&C::initial_density>("initial_density", positive_to(1)),
    field<&C::step>("consolidation_step", positive_to(1)),
    field<&C::target_energy>("target_energy", positive_to(1)),
    field<&C::target_before_relaxation>("target_before_relaxation", none),
    field<&C::max_density>("max_density", positive_to(2)),
    field<&D::step_fraction>("step_fraction", {0, 1, true, true}),
    field<&D::longest_step>("longest_step", positive_to(1)),
    field<&D::final_distance>("final_distance", positive_to(1)),
    field<&D::fit_window>("fit_window", positive_to(1)),
    field<&P::max_steps>("max_steps", {1, 1e6}),
    field<&C::evaluations>("consolidation_evaluations", {1, 1e9}),
    field<&D::control>("control", none),
    field<&P::cell>("cell", none),
    field<&Cohesion::strength>("cohesion.strength", {0, 1}),
    field<&Cohesion::range>("cohesion.range", positive_to(1)),
    field<&P::cohesion_until>("cohesion.until", none),
    field<&P::cycles>("cycles", {0, 1000}),
    field<&M::method>("method", none, Group::minimiser),
    field<&M::residual>("residual", positive_to(1), Group::minimiser),
    field<&M::energy_change>("energy_change", {0, 1}, Group::minimiser),
    field<&M::max_evaluations>("max_evaluations", {1, 1e9}, Group::minimiser),
};

/// A parameter of version 0.1.0, and what to do without it.
struct Removed {
  std::string_view name, remedy;
};
constexpr std::string_view is_fixed = "delete it; its default is now the only value";
constexpr std::array removed{
    Removed{"consolidation", "use \"consolidation_evaluations\": 50 in place of \"hasty\", and delete \"relaxed\""},
    Removed{"consolidation_residual", "use \"consolidation_evaluations\" to limit the relaxation"},
    Removed{"event_resolution", "use a smaller \"step_fraction\""},
    Removed{"consolidation_energy", is_fixed},
    Removed{"unjammed_energy", is_fixed},
    Removed{"history", is_fixed},
};

/// Methods that a manifest may choose. The engine has others for comparison (`isojam chart`).
constexpr std::array methods{Method::multipliers, Method::newton, Method::lbfgs};
constexpr std::array method_names{to_string(methods[0]), to_string(methods[1]), to_string(methods[2])};

/// Name of the object in the group that has the parameter; otherwise the name of the parameter.
std::string_view key_in_group(const Field& field) { return field.name.substr(0, field.name.find('.')); }

/// Key of a nested parameter in its object.
std::string key_in_object(const Field& field) { return std::string(field.name.substr(field.name.find('.') + 1)); }

}  // namespace

std::span<const Field> all_fields() { return fields; }

bool is_nested(const Field& field) { return field.name.find('.') != std::string_view::npos; }

std::string pointer_of(const Field& field) {
  const std::string group = "/" + std::string(to_string(field.group)) + "/" + std::string(key_in_group(field));
  return is_nested(field) ? group + "/" + key_in_object(field) : group;
}

const Field* find_field(std::string_view name) {
  const auto found = std::find_if(fields.begin(), fields.end(), [&](const Field& f) { return f.name == name; });
  return found == fields.end() ? nullptr : found;
}

void refuse_removed(const JsonPlace& place) {
  for (const auto& [name, remedy] : removed)
    place.read_if_any(std::string(name), [&, &text = remedy](const JsonPlace& key) {
      key.refuse_with_remedy("the key was removed", std::string(text));
    });
}

std::string allowed_values(const Field& field) {
  JamOptions options;
  return std::visit(
      [&]<class T>(const T*) {
        if constexpr (std::is_same_v<T, Method>) return one_of(method_names);
        return allowed_option<T>(field.range);
      },
      field.slot(options));
}

void read_field(const JsonPlace& place, const Field& field, JamOptions& options) {
  std::visit(
      [&]<class T>(T* value) {
        if constexpr (std::is_same_v<T, Method>)
          *value = methods[place.choice(method_names)];
        else
          read_option(place, field.range, *value);
      },
      field.slot(options));
}

Json field_value(const Field& field, JamOptions options) {
  return std::visit([](const auto* value) { return option_json(*value); }, field.slot(options));
}

Json group_values(Group group, const JamOptions& options) {
  Json values = Json::object();
  for (const auto& field : fields) {
    if (field.group != group) continue;
    Json& value = values[std::string(key_in_group(field))];
    (is_nested(field) ? value[key_in_object(field)] : value) = field_value(field, options);
  }
  return values;
}

void erase_field(Json& values, const Field& field) {
  const std::string key(key_in_group(field));
  if (!values.contains(key)) return;
  if (is_nested(field)) values[key].erase(key_in_object(field));
  if (!is_nested(field) || values[key].empty()) values.erase(key);
}

void read_group_fields(const JsonPlace& place, Group group, std::span<const std::string_view> others,
                       std::string (*elsewhere)(std::string_view),
                       const std::function<void(const JsonPlace&, const Field&)>& read) {
  std::vector<std::string_view> names(others.begin(), others.end());
  std::map<std::string, std::vector<std::string_view>> objects;
  for (const auto& field : fields) {
    if (field.group != group) continue;
    auto& members = objects[std::string(key_in_group(field))];
    if (members.empty()) names.push_back(key_in_group(field));
    members.push_back(field.name.substr(field.name.find('.') + 1));
  }
  refuse_removed(place);
  place.expect_keys(names, elsewhere);
  for (const auto& field : fields) {
    if (field.group != group) continue;
    const std::string key(key_in_group(field));
    place.read_if_any(key, [&](const JsonPlace& value) {
      if (!is_nested(field)) return read(value, field);
      value.expect_keys(objects.at(key));
      value.read_if_any(key_in_object(field), [&](const JsonPlace& member) { read(member, field); });
    });
  }
}

}  // namespace isojam
