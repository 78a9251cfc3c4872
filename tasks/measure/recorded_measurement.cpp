#include "tasks/measure/recorded_measurement.hpp"

#include <algorithm>
#include <string>

namespace isojam {

Measurement recorded_measurement(Measure what, const Json& record) {
  const std::string name(to_string(what));
  const auto part_of = [&](const Json& json) {
    Json part = Json::object();
    for (const auto& key : {name, name + "_reason"}) {
      if (json.contains(key)) part[key] = json.at(key);
    }
    return part;
  };
  Measurement measurement;
  for (const auto& state : record.at("states")) measurement.states.push_back(part_of(state));
  measurement.replicate = part_of(record);
  if (record.contains("nearest_only")) {
    const auto& names = record.at("nearest_only");
    measurement.nearest_only = std::find(names.begin(), names.end(), name) != names.end();
  }
  for (const auto flag : definition_of(what).flags) {
    const auto& flags = record.at("flags");
    if (std::find(flags.begin(), flags.end(), to_string(flag)) != flags.end())
      measurement.flags.emplace_back(to_string(flag));
  }
  return measurement;
}

}  // namespace isojam
