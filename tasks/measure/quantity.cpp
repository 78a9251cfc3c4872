#include "tasks/measure/quantity.hpp"

#include <algorithm>
#include <cassert>
#include <map>
#include <string>
#include <vector>

#include "tasks/measure/measure.hpp"
#include "tasks/measure/rearrangements.hpp"

namespace isojam {
namespace {

std::vector<Quantity> in_order_of_tables() {
  std::vector<Quantity> list{phi_j_quantity, phi_0_quantity};
  for (const Measure measure : all_measures) {
    for (Quantity quantity : definition_of(measure).quantities) {
      quantity.measure = measure;
      list.push_back(quantity);
    }
  }
  for (const Quantity& quantity : rearrangement_quantities()) list.push_back(quantity);
  std::map<std::string_view, std::size_t> last;
  for (std::size_t k = 0; k < list.size(); ++k) last[list[k].group.name] = k;
  std::stable_sort(list.begin(), list.end(),
                   [&](const Quantity& a, const Quantity& b) { return last.at(a.group.name) < last.at(b.group.name); });
  return list;
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

QuantityPlace place_of(Json& record, const Quantity& quantity) {
  const Json::json_pointer pointer{std::string(quantity.pointer)};
  return {record[pointer.parent_pointer()], pointer.back()};
}

void put(Json& record, const Quantity& quantity, double value) {
  const auto place = place_of(record, quantity);
  put_number(place.object, place.key, value);
}

void put(Json& record, const Quantity& quantity, const std::optional<double>& value, std::string_view reason) {
  const auto place = place_of(record, quantity);
  put_optional(place.object, place.key, value, reason);
}

}  // namespace isojam
