#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/solve/jam.hpp"
#include "tasks/json_text.hpp"

namespace isojam {

/// What is measured on the states of an expansion, beyond φ_J. Each is a node of the task graph and depends on no
/// other.
enum class Measure { contacts, order, clusters, modes, moduli, rigidity };
inline constexpr std::array all_measures{Measure::contacts, Measure::order,  Measure::clusters,
                                         Measure::modes,    Measure::moduli, Measure::rigidity};
std::string_view to_string(Measure measure);

struct MeasureOptions {
  int modes = 50;  ///< vibrations wanted at either end of the spectrum; the paper averages over 50
};

/// What one measurement adds to the record of a replicate. A number that is null has its reason beside it.
struct Measurement {
  std::vector<Json> states;         ///< an object for each of jam.states, which goes into the record of that state
  Json replicate = Json::object();  ///< what takes all states together, which goes into the record itself
  std::vector<std::string> flags;   ///< reservations about the replicate
};

/// Of a result with states. Pure; may be called from several threads at once.
Measurement measure(Measure what, const JamResult& jam, const MeasureOptions& options = {});

/// Index in jam.states of the state nearest jamming: the one of lowest density among those of positive energy; nullopt
/// if there is none.
std::optional<std::size_t> nearest_state(const JamResult& jam);

}  // namespace isojam
