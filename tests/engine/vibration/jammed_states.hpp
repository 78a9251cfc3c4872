#pragma once

#include "engine/solve/jam.hpp"

namespace isojam {

/// The states that one run of the protocol leaves on its way to φ − φ_J < final_distance, minimised to a residual of
/// 1e-9. Made once per program and argument.
const JamResult& jammed(SolidKind kind, int particles, double final_distance, std::uint64_t seed = 1);

/// The state nearest jamming.
inline const Packing& nearest_state(const JamResult& result) { return result.states.back(); }

}  // namespace isojam
