#pragma once

#include <Eigen/Core>

#include "engine/solve/factor/block_cholesky.hpp"

namespace isojam {

/// Solution (A + U Uᵀ)⁻¹ b from the factors of A alone, y − A⁻¹U (1 + Uᵀ A⁻¹U)⁻¹ Uᵀy with y = A⁻¹b (Woodbury). Costs a
/// solve for b and one for each column of U, of which there may be none. What U holds down is wrong by about
/// ε |U Uᵀ|/|A| relative, the norm of A on the span of U: where that matters the sum must be factorised.
Eigen::VectorXd solve_updated(const BlockCholesky& factor, const Eigen::MatrixXd& u, const Eigen::VectorXd& b);

}  // namespace isojam
