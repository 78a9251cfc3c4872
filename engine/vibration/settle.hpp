#pragma once

#include <stop_token>

#include "engine/solve/jam.hpp"

namespace isojam {

/// Relaxes every state of an expansion that is a saddle to a minimum (follow_downhill), and fits φ_J again.
/// JamStep::descents is positive for the changed states. A minimum keeps its bits. If a state does not reach a stable
/// equilibrium, its original is kept.
void settle(JamResult& result, const JamOptions& options, std::stop_token stop = {});

}  // namespace isojam
