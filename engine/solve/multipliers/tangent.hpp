#pragma once

#include <Eigen/Core>
#include <vector>

#include "engine/solve/factor/definite_solver.hpp"
#include "engine/solve/multipliers/envelope_state.hpp"

namespace isojam {

/// First-order response of an equilibrium to a change of density, cell shape or load.
struct Tangent {
  Eigen::VectorXd step;                   ///< step (packing.hpp) that the particles make after the strain `imposed`
  std::vector<ContactMultiplier> forces;  ///< the unchanged multipliers, and the shifts after the change
};

/// Computes the response −M⁻¹ ∂g of the equilibrium `from`. M is the matrix of second derivatives of the envelope Φ
/// (EnvelopeEvaluation) plus `shift`·1, and ∂g is a change of the gradient. If the volume is fixed, the strain
/// `imposed` of the cell and all centres causes ∂g. If the volume is free, the difference between the load of
/// `evaluator` and the load at the equilibrium causes ∂g, and `imposed` must be zero. The step is shortened so that
/// no particle moves farther than `longest`. The step is zero if M is not positive definite.
Tangent tangent(const EnvelopeState& from, const Eigen::Matrix3d& imposed, double shift, double longest,
                EnvelopeEvaluator& evaluator, DefiniteSolver& solver, MinimiseWork& work);

}  // namespace isojam
