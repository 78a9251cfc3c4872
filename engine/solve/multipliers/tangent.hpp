#pragma once

#include <Eigen/Core>
#include <vector>

#include "engine/solve/factor/block_cholesky.hpp"
#include "engine/solve/multipliers/envelope_state.hpp"

namespace isojam {

/// Response of an equilibrium to a change of density or pressure, to first order.
struct Tangent {
  Eigen::VectorXd step;                   ///< step in the format of moved(), in addition to the prescribed strain
  std::vector<ContactMultiplier> forces;  ///< the unchanged multipliers, and the shifts after the change
};

/// Computes the response −M⁻¹ ∂g of the equilibrium `from`. M is the matrix of second derivatives of Φ plus `shift`·1.
/// ∂g is the change of the gradient due to the strain `imposed` of the cell and all centres. If the volume is free, ∂g
/// is instead due to the load of `evaluator`, which differs from the load in the equilibrium `from`, and `imposed` is
/// not used. The step is scaled so that no particle moves farther than `longest`. If M is not positive definite, the
/// step is zero.
Tangent tangent(const EnvelopeState& from, const Eigen::Matrix3d& imposed, double shift, double longest,
                EnvelopeEvaluator& evaluator, BlockCholesky& factor, MinimiseWork& work);

}  // namespace isojam
