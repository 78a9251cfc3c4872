#include "tasks/fields.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <type_traits>

namespace isojam {
namespace {

constexpr std::array methods{Method::conjugate_gradient, Method::fire, Method::lbfgs, Method::newton};

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
    field<&P::approach>("approach", {0, 1, true, true}),
    field<&P::longest_step>("longest_step", positive_to(1)),
    field<&P::final_distance>("final_distance", positive_to(1)),
    field<&P::fit_window>("fit_window", positive_to(1)),
    field<&P::max_steps>("max_steps", {1, 1e6}),
    field<&P::passing_residual>("passing_residual", positive_to(1)),
    field<&P::passing_energy>("passing_energy", {0, 1}),
    field<&P::passing_evaluations>("passing_evaluations", {1, 1e9}),
    field<&M::method>("method", none),
    field<&M::residual>("residual", positive_to(1)),
    field<&M::energy_change>("energy_change", {0, 1}),
    field<&M::unjammed_energy>("unjammed_energy", {0, 1}),
    field<&M::max_evaluations>("max_evaluations", {1, 1e9}),
    field<&M::history>("history", {1, 1000}),
};

const auto names_of_methods = [] {
  std::array<std::string_view, methods.size()> names;
  std::transform(methods.begin(), methods.end(), names.begin(), [](Method m) { return to_string(m); });
  return names;
};

template <class... F>
struct Overloaded : F... {
  using F::operator()...;
};
template <class... F>
Overloaded(F...) -> Overloaded<F...>;

}  // namespace

std::string_view to_string(Group group) { return group == Group::protocol ? "protocol" : "minimiser"; }

std::span<const Field> all_fields() { return fields; }

const Field* find_field(std::string_view name) {
  const auto found = std::find_if(fields.begin(), fields.end(), [&](const Field& f) { return f.name == name; });
  return found == fields.end() ? nullptr : found;
}

std::span<const std::string_view> method_names() {
  static const auto names = names_of_methods();
  return names;
}

std::string allowed_values(const Field& field) {
  JamOptions options;
  return std::visit(
      Overloaded{[&](double*) { return number_in(field.range); }, [&](int*) { return integer_in(field.range); },
                 [&](long*) { return integer_in(field.range); }, [&](bool*) { return std::string("true or false"); },
                 [&](Method*) { return quoted_list(method_names()); }},
      field.slot(options));
}

void read_field(const JsonPlace& place, const Field& field, JamOptions& options) {
  std::visit(Overloaded{[&](double* x) { *x = place.number(field.range); },
                        [&](int* n) { *n = static_cast<int>(place.integer(field.range)); },
                        [&](long* n) { *n = static_cast<long>(place.integer(field.range)); },
                        [&](bool* b) { *b = place.boolean(); },
                        [&](Method* m) { *m = methods[place.choice(method_names())]; }},
             field.slot(options));
}

Json field_value(const Field& field, JamOptions options) {
  return std::visit(
      Overloaded{[](const Method* m) { return Json(to_string(*m)); }, [](const auto* value) { return Json(*value); }},
      field.slot(options));
}

Json group_values(Group group, const JamOptions& options) {
  Json values = Json::object();
  for (const auto& field : fields) {
    if (field.group == group) values[std::string(field.name)] = field_value(field, options);
  }
  return values;
}

}  // namespace isojam
