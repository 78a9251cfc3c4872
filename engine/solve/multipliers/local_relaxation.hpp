#pragma once

#include <Eigen/Core>
#include <vector>

#include "engine/solve/multipliers/envelope_state.hpp"

namespace isojam {

/// Flags of the particles whose contacts made `there` another state than the second-order series of Φ at `here`
/// promised for `step`, and of the particles that touch these. A contact counts if it is wrong by a part of the
/// `promised` decrease.
std::vector<char> mispredicted(const EnvelopeState& here, const EnvelopeState& there, const Eigen::VectorXd& step,
                               double promised);

/// Minimises Φ over the flagged particles alone, in a few steps of Levenberg and Marquardt from `shift`, until what
/// they promise is a small part of `promised`. True if `state` was changed. It is cheap, a system of so many particles
/// at a time, and it makes good what an event far smaller than the packing spoils for all of it.
bool relax_locally(const std::vector<char>& flags, double shift, double promised, EnvelopeEvaluator& evaluator,
                   EnvelopeState& state, MinimiseWork& work);

}  // namespace isojam
