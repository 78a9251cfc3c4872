#include "tasks/manifest/fields.hpp"

#include <algorithm>
#include <array>
#include <type_traits>

#include "tasks/json/options.hpp"

namespace isojam {
namespace {

constexpr Range positive_to(double high) { return {0, high, true, false}; }
constexpr Range none{};

template <class>
struct MemberOf;
template <class T, class S>
struct MemberOf<T S::*> {
  using Struct = S;
};

template <auto member>
constexpr Field field(std::string_view name, Range range) {
  constexpr bool outer = std::is_same_v<typename MemberOf<decltype(member)>::Struct, JamOptions>;
  const auto slot = [](JamOptions& options) -> Slot {
    if constexpr (outer) {
      return &(options.*member);
    } else {
      return &(options.minimise.*member);
    }
  };
  return {name, outer ? Group::protocol : Group::minimiser, slot, range};
}

using P = JamOptions;
using M = MinimiseOptions;

constexpr std::array fields{
    field<&P::initial_density>("initial_density", positive_to(1)),
    field<&P::consolidation_step>("consolidation_step", positive_to(1)),
    field<&P::target_energy>("target_energy", positive_to(1)),
    field<&P::target_before_relaxation>("target_before_relaxation", none),
    field<&P::max_density>("max_density", positive_to(2)),
    field<&P::step_fraction>("step_fraction", {0, 1, true, true}),
    field<&P::longest_step>("longest_step", positive_to(1)),
    field<&P::event_resolution>("event_resolution", {0, 1}),
    field<&P::final_distance>("final_distance", positive_to(1)),
    field<&P::fit_window>("fit_window", positive_to(1)),
    field<&P::max_steps>("max_steps", {1, 1e6}),
    field<&P::consolidation_residual>("consolidation_residual", positive_to(1)),
    field<&P::consolidation_energy>("consolidation_energy", {0, 1}),
    field<&P::consolidation_evaluations>("consolidation_evaluations", {1, 1e9}),
    field<&P::consolidation>("consolidation", none),
    field<&P::control>("control", none),
    field<&P::cell>("cell", none),
    field<&M::method>("method", none),
    field<&M::residual>("residual", positive_to(1)),
    field<&M::energy_change>("energy_change", {0, 1}),
    field<&M::unjammed_energy>("unjammed_energy", {0, 1}),
    field<&M::max_evaluations>("max_evaluations", {1, 1e9}),
    field<&M::history>("history", {1, 1000}),
};

/// A key of an earlier version and its present name.
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
