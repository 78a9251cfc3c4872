#pragma once

#include <Eigen/Core>
#include <vector>

#include "engine/solve/multipliers/envelope_state.hpp"

namespace isojam {

/// Flags the particles of mispredicted contacts, and the particles that touch them. A contact is mispredicted if its
/// contribution to `there` differs from the second-order series of Φ at `here` for `step` by a given part of the
/// `promised` decrease.
std::vector<char> mispredicted(const EnvelopeState& here, const EnvelopeState& there, const Eigen::VectorXd& step,
                               double promised);

/// Minimises Φ over the flagged particles only, in a few Levenberg–Marquardt steps from `shift`, until their predicted
/// decrease is a small part of `promised`. Returns true if `state` was changed. It is cheap, because it solves systems
/// of few particles. It repairs a local contact change that would otherwise cause the whole step to be rejected.
bool relax_locally(const std::vector<char>& flags, double shift, double promised, EnvelopeEvaluator& evaluator,
                   EnvelopeState& state, MinimiseWork& work);

}  // namespace isojam
