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
  int modes = 50;  ///< number of vibrational modes at each end of the spectrum; the paper averages over 50 modes
  ShearOptions shear;
  bool exponents_of_all_states = false;  ///< false: the measure `exponents` measures only the state nearest jamming
  Cohesion cohesion{};                   ///< cohesion that acts in the states; by default none
  double gap = 0;                        ///< pairs with a smaller gap count as contacts; only in packings as given
};

/// Part of a record that one measure writes. If a number is null, another field states the reason.
struct Measurement {
  /// one object for each element of jam.states; its members are added to the record of the state
  std::vector<Json> states;
  /// results from several states; its members are added to the record of the replicate
  Json replicate = Json::object();
  std::vector<std::string> flags;  ///< flags of the replicate
  /// true if only the nearest state was measured, because the other states were not saved; their objects are then empty
  bool nearest_only = false;
};

/// The fields that a measure adds to the record of a state or of a replicate. Both functions are null if it adds none.
struct MeasurePart {
  Fields (*fields)() = nullptr;
  /// Throws InputError, or notes the errors if the place collects them, unless an object has exactly these fields.
  void (*check)(const JsonPlace& place) = nullptr;
};
/// The part whose fields T describes.
template <Described T>
constexpr MeasurePart part_of() {
  return {fields_of<T>, [](const JsonPlace& place) { read<T>(place); }};
}

/// Definition of a measure.
struct MeasureDefinition {
  MeasurePart state = {}, replicate = {};
  /// function that computes the measure
  Measurement (*measure)(const JamResult& jam, const MeasureOptions& options);
  std::span<const Flag> flags = {};  ///< flags that this measure sets, in the order in which the record lists them
  bool by_default = false;           ///< true if the measure is computed for manifests without the key `measure`
  /// true if the measure needs minima; saddles are then relaxed along their negative modes before any measure
  bool needs_minima = false;
  /// true if the measure can be computed for packings with cohesion at zero pressure
  bool at_zero_pressure = false;
  bool as_given = false;  ///< true if the measure can be computed for a packing that was not relaxed
};

inline const MeasureDefinition& definition_of(Measure measure) {
  return *measure_definitions[static_cast<std::size_t>(measure)];
}

/// Computes a measure. `jam` must have states. The function has no side effects, and several threads may call it at the
/// same time.
Measurement measure(Measure what, const JamResult& jam, const MeasureOptions& options = {});

/// Computes a measure for the nearest state alone. The other states of `jam` may have no particles.
Measurement measure_nearest(Measure what, const JamResult& jam, const MeasureOptions& options);

/// Index in jam.states of the nearest state: the state with the lowest density among the states with contacts, whose
/// energy is not 0. A packing as given counts with any energy. States without particles are skipped. nullopt if no
/// state has contacts.
std::optional<std::size_t> nearest_state(const JamResult& jam);

}  // namespace isojam
