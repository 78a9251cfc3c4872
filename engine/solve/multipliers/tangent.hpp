#pragma once

#include <Eigen/Core>
#include <vector>

#include "engine/solve/factor/block_cholesky.hpp"
#include "engine/solve/multipliers/envelope_state.hpp"

namespace isojam {

/// How an equilibrium answers a change of density or pressure to first order.
struct Tangent {
  Eigen::VectorXd step;                   ///< as moved() takes it, beside the strain that was imposed
  std::vector<ContactMultiplier> forces;  ///< multipliers as they were, shifts as the change makes them
};

/// The answer −M⁻¹ ∂g of the equilibrium `from`, M the second derivatives of Φ + `shift`·1, ∂g the change of its
/// gradient by a strain of the cell and of all centres, or where the volume is free by the load of `evaluator`, which
/// is not the one that `from` balances; the strain is not used then. No particle moves farther than `longest`. Where M
/// is not positive definite the packing stays as it was.
Tangent tangent(const EnvelopeState& from, const Eigen::Matrix3d& imposed, double shift, double longest,
                EnvelopeEvaluator& evaluator, BlockCholesky& factor, MinimiseWork& work);

}  // namespace isojam
