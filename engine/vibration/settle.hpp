#pragma once

#include <stop_token>

#include "engine/solve/jam.hpp"

namespace isojam {

/// Takes every state of an expansion that is a saddle downhill to a minimum (follow_downhill) and fits φ_J again to
/// what is there then; JamStep::descents tells which states that befell. A minimum keeps its bits. A state that ends
/// without balance, or still unstable, is left as it was.
void settle(JamResult& result, const JamOptions& options, std::stop_token stop = {});

}  // namespace isojam
