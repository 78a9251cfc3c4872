#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "engine/shear/shear.hpp"
#include "engine/solve/jam.hpp"
#include "tasks/io/json.hpp"
#include "tasks/measure/flag.hpp"
#include "tasks/measure/list.hpp"
#include "tasks/measure/quantity.hpp"

namespace isojam {

struct MeasureOptions {
  int modes = 50;  ///< number of vibrational modes at each end of the spectrum; the paper averages over 50
  ShearOptions shear;
};

/// Contribution of one measure to the record of a replicate. If a number is null, another field states the reason.
struct Measurement {
  std::vector<Json> states;  ///< an object for each element of jam.states; it is added to the record of the state
  Json replicate = Json::object();  ///< results that use all states; they are added to the record of the replicate
  std::vector<std::string> flags;   ///< flags of the replicate
};

/// A measure: its quantities in tables, and its function.
struct MeasureDefinition {
  std::span<const Quantity> quantities;
  Measurement (*measure)(const JamResult& jam, const MeasureOptions& options);
  std::span<const Flag> flags = {};  ///< flags that only this measure sets, in the order in which it sets them
  bool by_default = false;           ///< true if the measure is computed when a manifest names no measures
  /// true if the measure is meaningful only at minima; saddles are then first relaxed along their negative modes
  bool needs_minima = false;
};

inline const MeasureDefinition& definition_of(Measure measure) {
  return *measure_definitions[static_cast<std::size_t>(measure)];
}

/// Computes a measure for a result that has states. It has no side effects; several threads may call it at the same
/// time.
Measurement measure(Measure what, const JamResult& jam, const MeasureOptions& options = {});

/// Index in jam.states of the state nearest jamming, which is the state with the lowest density among the states with
/// positive energy. nullopt if there is none.
std::optional<std::size_t> nearest_state(const JamResult& jam);

}  // namespace isojam
