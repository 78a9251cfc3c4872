#pragma once

#include <Eigen/Core>

#include "engine/solve/factor/block_cholesky.hpp"

namespace isojam {

/// Solution (A + U Uᵀ)⁻¹ b from the factors of A only, y − A⁻¹U (1 + Uᵀ A⁻¹U)⁻¹ Uᵀy with y = A⁻¹b (Woodbury). Costs a
/// solve for b and one for each column of U, which may have none. On the span of U the relative error is about ε |U
/// Uᵀ|/|A|, with the norm of A on that span; if this matters, the sum must be factorised.
Eigen::VectorXd solve_updated(const BlockCholesky& factor, const Eigen::MatrixXd& u, const Eigen::VectorXd& b);

}  // namespace isojam
