#pragma once

#include <Eigen/Core>
#include <vector>

#include "engine/solve/multipliers/envelope_state.hpp"

namespace isojam {

/// Flags the particles of contacts that the model of a step predicts wrongly, and all particles that touch these
/// particles. `step` leads from `here` to `there`. The model of a contact is the second-order series of its
/// contribution to the envelope Φ. The model is wrong if its error in `there` is more than 10 % of
/// `predicted_decrease`, the decrease of Φ that the model predicts for the whole packing.
std::vector<char> mispredicted(const EnvelopeState& here, const EnvelopeState& there, const Eigen::VectorXd& step,
                               double predicted_decrease);

/// Minimises Φ with respect to the flagged particles only. The method is a few Levenberg–Marquardt steps; the first one
/// has the Levenberg–Marquardt shift `shift`. The steps end when the predicted decrease of a step is a small
/// fraction of `predicted_decrease`. Returns true if `state` was changed. The cost is low, because the linear systems
/// contain only a few particles. Without this function, a contact that forms or breaks would often cause the whole step
/// to be rejected.
bool relax_locally(const std::vector<char>& flags, double shift, double predicted_decrease,
                   EnvelopeEvaluator& evaluator, EnvelopeState& state, MinimiseWork& work);

}  // namespace isojam
