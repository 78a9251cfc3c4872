#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "engine/shear/shear.hpp"
#include "engine/solve/jam.hpp"
#include "tasks/json/json.hpp"
#include "tasks/measure/flag.hpp"
#include "tasks/measure/list.hpp"
#include "tasks/measure/quantity.hpp"

namespace isojam {

struct MeasureOptions {
  int modes = 50;  ///< number of vibrational modes at either end of the spectrum; the paper averages over 50
  ShearOptions shear;
};

/// Contribution of one measure to the record of a replicate. A number that is null has its reason beside it.
struct Measurement {
  std::vector<Json> states;         ///< an object for each of jam.states, added to the record of that state
  Json replicate = Json::object();  ///< results from all states together, added to the record of the replicate
  std::vector<std::string> flags;   ///< flags of the replicate
};

/// A measure: its quantities in tables, and its function.
struct MeasureDefinition {
  std::span<const Quantity> quantities;
  Measurement (*measure)(const JamResult& jam, const MeasureOptions& options);
  std::span<const Flag> flags = {};  ///< flags that only this measure sets, in the order in which it sets them
  bool by_default = false;           ///< used if a manifest names no measures
  bool needs_minima = false;  ///< meaningful at minima only: saddles are first relaxed along their negative modes
};

inline const MeasureDefinition& definition_of(Measure measure) {
  return *measure_definitions[static_cast<std::size_t>(measure)];
}

/// Measures a result with states. Pure; may be called from several threads at once.
Measurement measure(Measure what, const JamResult& jam, const MeasureOptions& options = {});

/// The index in jam.states of the state nearest jamming: the one of lowest density among those of positive energy;
/// nullopt if there is none.
std::optional<std::size_t> nearest_state(const JamResult& jam);

}  // namespace isojam
