#pragma once

#include <Eigen/Core>
#include <vector>

#include "engine/solve/factor/block_cholesky.hpp"
#include "engine/solve/multipliers/envelope_state.hpp"

namespace isojam {

/// First-order response of an equilibrium to a change of density or pressure.
struct Tangent {
  Eigen::VectorXd step;                   ///< step in the form of moved(), in addition to the imposed strain
  std::vector<ContactMultiplier> forces;  ///< unchanged multipliers, and shifts after the change
};

/// The response −M⁻¹ ∂g of the equilibrium `from`. M is the second derivatives of Φ + `shift`·1, and ∂g is the change
/// of its gradient due to a strain of the cell and of all centres. If the volume is free, ∂g is instead due to the load
/// of `evaluator`, which differs from the load in the equilibrium `from`; `imposed` is then not used. No particle moves
/// farther than `longest`. If M is not positive definite, the step is zero.
Tangent tangent(const EnvelopeState& from, const Eigen::Matrix3d& imposed, double shift, double longest,
                EnvelopeEvaluator& evaluator, BlockCholesky& factor, MinimiseWork& work);

}  // namespace isojam
