#pragma once

#include <stop_token>

#include "engine/solve/jam.hpp"

namespace isojam {

/// Relaxes every state of a decompression that is a saddle to a minimum with relax_to_minimum(), and fits φ_J again if
/// a state has changed. JamStep::descents is positive for the changed states. A state that is already a minimum keeps
/// its bits. If no minimum is found for a state, the original state is kept.
void settle(JamResult& result, const JamOptions& options, std::stop_token stop = {});

}  // namespace isojam
