#pragma once

#include <stop_token>

#include "engine/solve/jam.hpp"

namespace isojam {

/// Applies relax_to_minimum() to every state of a decompression. If a state is a saddle, the minimum that is found
/// replaces it, and JamStep::descents is then positive. If no minimum is found, the saddle is kept. A state that is
/// already a minimum keeps its bits. A state whose packing is not known is skipped; its element of JamResult::states
/// has no particles. φ_J is fitted again if a state has changed.
void settle(JamResult& result, const JamOptions& options, std::stop_token stop = {});

}  // namespace isojam
