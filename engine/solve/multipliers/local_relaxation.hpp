#pragma once

#include <Eigen/Core>
#include <vector>

#include "engine/solve/multipliers/envelope_state.hpp"

namespace isojam {

/// Flags the particles of contacts that the model of a step predicts wrongly, and the particles that touch these
/// particles. A contact is predicted wrongly if its contribution to Φ in `there` differs from the second-order series
/// of Φ at `here` for `step` by more than a given fraction of the `promised` decrease.
std::vector<char> mispredicted(const EnvelopeState& here, const EnvelopeState& there, const Eigen::VectorXd& step,
                               double predicted_decrease);

/// Minimises Φ with respect to the flagged particles only. It makes a few Levenberg–Marquardt steps, beginning with the
/// shift `shift`, until the predicted decrease is a small fraction of `promised`. Returns true if `state` was changed.
/// This costs little, because the linear systems contain only few particles. Without it, a contact that forms or breaks
/// would often cause the whole step to be rejected.
bool relax_locally(const std::vector<char>& flags, double shift, double predicted_decrease,
                   EnvelopeEvaluator& evaluator, EnvelopeState& state, MinimiseWork& work);

}  // namespace isojam
