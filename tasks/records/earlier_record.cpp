#include "tasks/records/earlier_record.hpp"

#include <array>
#include <string>
#include <utility>

#include "tasks/measure/list.hpp"
#include "tasks/records/record.hpp"

namespace isojam {
namespace {

/// In version 3, the measure `contacts` wrote its numbers into the state itself, between "step" and the objects of
/// other measures. This function moves them into the object "contacts".
Json upgraded_state(const Json& state) {
  if (!state.is_object()) return state;
  Json upgraded = Json::object(), contacts = Json::object();
  bool after_step = false;
  for (const auto& item : state.items()) {
    const bool of_contacts = after_step && !from_string<Measure>(item.key());
    (of_contacts ? contacts : upgraded)[item.key()] = item.value();
    if (item.key() != "step") continue;
    after_step = true;
    upgraded["contacts"] = nullptr;  // keeps the position of this key
  }
  if (contacts.empty()) {
    upgraded.erase("contacts");
  } else {
    upgraded["contacts"] = std::move(contacts);
  }
  return upgraded;
}

/// A key of version 3. In version 4 its value is `key` in the object of the measure.
struct Moved {
  std::string_view before, measure, key;
};
constexpr std::array moved{Moved{"mode_scaling", "modes", "scaling"}, Moved{"moduli_scaling", "moduli", "scaling"},
                           Moved{"freed", "strict", "freed"}};

void put_upgraded(const std::string& key, const Json& value, Json& record) {
  constexpr std::string_view reason = "_reason";
  for (const auto& [before, measure, now] : moved) {
    const std::string name(measure);
    if (key == before) {
      record[name] = value.is_null() ? Json(nullptr) : Json{{now, value}};
      return;
    }
    if (key == std::string(before) + std::string(reason)) {
      record[name + std::string(reason)] = value;
      return;
    }
  }
  record[key] = value;
}

}  // namespace

bool is_earlier_record(const Json& document) {
  return document.is_object() && document.contains("schema") && document.at("schema") == earlier_record_schema;
}

Json upgraded_record(Json record) {
  if (!is_earlier_record(record)) return record;
  Json upgraded = Json::object();
  for (const auto& item : record.items()) put_upgraded(item.key(), item.value(), upgraded);
  upgraded["schema"] = record_schema;
  if (upgraded.contains("nearest")) upgraded["nearest"] = upgraded_state(upgraded["nearest"]);
  if (upgraded.contains("states") && upgraded["states"].is_array()) {
    for (Json& state : upgraded["states"]) state = upgraded_state(state);
  }
  return upgraded;
}

}  // namespace isojam
