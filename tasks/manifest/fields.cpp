#include "tasks/manifest/fields.hpp"

#include <algorithm>
#include <array>
#include <type_traits>

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
    field<&D::event_resolution>("event_resolution", {0, 1}),
    field<&D::final_distance>("final_distance", positive_to(1)),
    field<&D::fit_window>("fit_window", positive_to(1)),
    field<&P::max_steps>("max_steps", {1, 1e6}),
    field<&C::residual>("consolidation_residual", positive_to(1)),
    field<&C::unjammed_energy>("consolidation_energy", {0, 1}),
    field<&C::evaluations>("consolidation_evaluations", {1, 1e9}),
    field<&C::relaxation>("consolidation", none),
    field<&D::control>("control", none),
    field<&P::cell>("cell", none),
    field<&M::method>("method", none, Group::minimiser),
    field<&M::residual>("residual", positive_to(1), Group::minimiser),
    field<&M::energy_change>("energy_change", {0, 1}, Group::minimiser),
    field<&M::unjammed_energy>("unjammed_energy", {0, 1}, Group::minimiser),
    field<&M::max_evaluations>("max_evaluations", {1, 1e9}, Group::minimiser),
    field<&M::history>("history", {1, 1000}, Group::minimiser),
};

/// A key that an earlier version used, and its present name.
struct Renamed {
  std::string_view before, now;
};
constexpr std::array renamed{
    Renamed{"approach", "step_fraction"},
    Renamed{"passing_residual", "consolidation_residual"},
    Renamed{"passing_energy", "consolidation_energy"},
    Renamed{"passing_evaluations", "consolidation_evaluations"},
};

}  // namespace

std::span<const Field> all_fields() { return fields; }

const Field* find_field(std::string_view name) {
  const auto found = std::find_if(fields.begin(), fields.end(), [&](const Field& f) { return f.name == name; });
  return found == fields.end() ? nullptr : found;
}

std::string_view new_name(std::string_view name) {
  const auto found = std::find_if(renamed.begin(), renamed.end(), [&](const Renamed& r) { return r.before == name; });
  return found == renamed.end() ? std::string_view() : found->now;
}

std::string allowed_values(const Field& field) {
  JamOptions options;
  return std::visit([&]<class T>(const T*) { return allowed_option<T>(field.range); }, field.slot(options));
}

void read_field(const JsonPlace& place, const Field& field, JamOptions& options) {
  std::visit([&](auto* value) { read_option(place, field.range, *value); }, field.slot(options));
}

Json field_value(const Field& field, JamOptions options) {
  return std::visit([](const auto* value) { return option_json(*value); }, field.slot(options));
}

Json group_values(Group group, const JamOptions& options) {
  Json values = Json::object();
  for (const auto& field : fields) {
    if (field.group == group) values[std::string(field.name)] = field_value(field, options);
  }
  return values;
}

}  // namespace isojam
