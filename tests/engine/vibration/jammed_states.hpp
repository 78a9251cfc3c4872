#pragma once

#include "engine/solve/jam.hpp"

namespace isojam {

/// The result of one run of the protocol, decompressed to φ − φ_J < final_distance, with residuals of 1e-9. Each call
/// with new arguments computes it; later calls with the same arguments return the same object.
const JamResult& jammed(SolidKind kind, int particles, double final_distance, std::uint64_t seed = 1);

/// The nearest state.
inline const Packing& nearest_state(const JamResult& result) { return result.states.back(); }

}  // namespace isojam
