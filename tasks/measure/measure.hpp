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
  int modes = 50;  ///< vibrations wanted at either end of the spectrum; the paper averages over 50
  ShearOptions shear;
};

/// What one measurement adds to the record of a replicate. A number that is null has its reason beside it.
struct Measurement {
  std::vector<Json> states;         ///< an object for each of jam.states, which goes into the record of that state
  Json replicate = Json::object();  ///< what takes all states together, which goes into the record itself
  std::vector<std::string> flags;   ///< reservations about the replicate
};

/// A measure: the numbers that tables take from it, and how it is made.
struct MeasureDefinition {
  std::span<const Quantity> quantities;
  Measurement (*measure)(const JamResult& jam, const MeasureOptions& options);
  std::span<const Flag> flags = {};  ///< that it may raise and no other measure does, in the order in which it does
  bool by_default = false;           ///< made where a manifest names none
  bool needs_minima = false;         ///< means something at minima only: saddles are followed downhill first
};

inline const MeasureDefinition& definition_of(Measure measure) {
  return *measure_definitions[static_cast<std::size_t>(measure)];
}

/// The measurement of a result with states. Pure; may be called from several threads at once.
Measurement measure(Measure what, const JamResult& jam, const MeasureOptions& options = {});

/// The index in jam.states of the state nearest jamming: the one of lowest density among those of positive energy;
/// nullopt if there is none.
std::optional<std::size_t> nearest_state(const JamResult& jam);

}  // namespace isojam
