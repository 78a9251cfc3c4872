#include "tasks/measure/recorded_measurement.hpp"

#include <algorithm>
#include <optional>
#include <string_view>

// Measures write to a record one after the other, in the order of all_measures. In a state each writes an object of its
// own name; `contacts`, the first, writes Z and its other numbers directly. In the replicate each writes to the
// pointers of its quantities, followed by the reason if one is null.

namespace isojam {
namespace {

constexpr std::string_view last_of_step = "step";  ///< the last key of a state before those of measures

/// The measure that a key of a state belongs to. `before` owns the previous key.
Measure owner_in_state(const std::string& key, Measure before) { return from_string<Measure>(key).value_or(before); }

Json of_state(Measure what, const Json& state) {
  Json own = Json::object();
  bool measured = false;
  Measure owner = all_measures.front();
  for (const auto& item : state.items()) {
    if (measured) {
      owner = owner_in_state(item.key(), owner);
      if (owner == what) own[item.key()] = item.value();
    }
    measured = measured || item.key() == last_of_step;
  }
  return own;
}

/// The measure with a quantity in this member of the record.
std::optional<Measure> owner_in_record(std::string_view key) {
  for (const auto& quantity : all_quantities()) {
    if (quantity.of != Quantity::Of::replicate || !quantity.measure) continue;
    if (quantity.pointer.substr(1, quantity.pointer.find('/', 1) - 1) == key) return quantity.measure;
  }
  return std::nullopt;
}

}  // namespace

Measurement recorded_measurement(Measure what, const Json& record) {
  Measurement measurement;
  for (const auto& state : record.at("states")) measurement.states.push_back(of_state(what, state));
  std::string reason;
  for (const auto& item : record.items()) {
    if (owner_in_record(item.key()) == what) {
      measurement.replicate[item.key()] = item.value();
      reason = item.key() + "_reason";
    } else if (item.key() == reason) {
      measurement.replicate[item.key()] = item.value();
    }
  }
  for (const auto flag : definition_of(what).flags) {
    const auto& flags = record.at("flags");
    if (std::find(flags.begin(), flags.end(), to_string(flag)) != flags.end())
      measurement.flags.emplace_back(to_string(flag));
  }
  return measurement;
}

}  // namespace isojam
