#include "tasks/measure/quantity.hpp"

#include <algorithm>
#include <cassert>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "tasks/io/fields.hpp"
#include "tasks/measure/measure.hpp"
#include "tasks/measure/rearrangements.hpp"

namespace isojam {
namespace {

constexpr std::string_view meaning_of_phi_j =
    "Jamming density φ_J: the density at E = 0, from a line that is fitted to φ as a function of (E/N)^(1/6). Packings "
    "with cohesion at zero pressure have none; `phi_0` takes its place.";
constexpr std::string_view meaning_of_phi_0 = "Density at zero pressure, of packings with cohesion.";

/// A quantity, and its place among those of its group.
struct Placed {
  Quantity quantity;
  int place = 0;
};

void add(std::vector<Placed>& list, const Fields& fields, Quantity::Of of, std::optional<Measure> measure) {
  for (auto& [name, pointer, field, can_be_absent] : columns_of(fields)) {
    const Column& column = field.quantity;
    if (column.name.empty()) continue;
    list.push_back({{name, pointer, column.group, field.unit_name.empty() ? Words("1") : field.unit_name, column.latex,
                     column.meaning.empty() ? field.meaning : column.meaning, of, measure, column.proportion,
                     column.kinds, column.cohesive},
                    column.place});
  }
}

std::vector<Quantity> in_order_of_tables() {
  constexpr auto of = Quantity::Of::replicate;
  std::vector<Placed> list(2);
  list[0].quantity = {"phi_j", "/phi_j/phi_j", main_group, "1", "\\phi_J", std::string(meaning_of_phi_j), of};
  list[1].quantity = {"phi_0", "/phi_0", main_group, "1", "\\phi_0", std::string(meaning_of_phi_0), of};
  list[1].quantity.cohesive = true;
  for (const Measure measure : all_measures) {
    const auto& definition = definition_of(measure);
    if (definition.state.fields) add(list, definition.state.fields(), Quantity::Of::state, measure);
    if (definition.replicate.fields) add(list, definition.replicate.fields(), of, measure);
  }
  add(list, fields_of<RearrangementPart>(), of, std::nullopt);
  std::map<std::string_view, std::size_t> last;
  for (std::size_t k = 0; k < list.size(); ++k) last[list[k].quantity.group.name] = k;
  const auto rank = [&](const Placed& entry) { return std::pair(last.at(entry.quantity.group.name), entry.place); };
  std::stable_sort(list.begin(), list.end(), [&](const Placed& a, const Placed& b) { return rank(a) < rank(b); });
  std::vector<Quantity> quantities;
  for (auto& entry : list) quantities.push_back(std::move(entry.quantity));
  return quantities;
}

}  // namespace

std::span<const Quantity> all_quantities() {
  static const auto list = in_order_of_tables();
  return list;
}

std::optional<std::size_t> quantity_index(std::string_view name) {
  const auto all = all_quantities();
  const auto found = std::find_if(all.begin(), all.end(), [&](const Quantity& q) { return q.name == name; });
  if (found == all.end()) return std::nullopt;
  return static_cast<std::size_t>(found - all.begin());
}

const Quantity& quantity(std::string_view name) {
  const auto index = quantity_index(name);
  assert(index);
  return all_quantities()[*index];
}

}  // namespace isojam
