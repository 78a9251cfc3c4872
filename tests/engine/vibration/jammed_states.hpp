#pragma once

#include "engine/solve/jam.hpp"

namespace isojam {

/// The states of one run of the protocol down to φ − φ_J < final_distance, minimised to a residual of 1e-9. Computed
/// once per program and arguments.
const JamResult& jammed(SolidKind kind, int particles, double final_distance, std::uint64_t seed = 1);

/// The state nearest to jamming.
inline const Packing& nearest_state(const JamResult& result) { return result.states.back(); }

}  // namespace isojam
