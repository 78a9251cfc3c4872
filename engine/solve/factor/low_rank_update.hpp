#pragma once

#include <Eigen/Core>

#include "engine/solve/factor/block_cholesky.hpp"

namespace isojam {

/// Computes (A + U Uᵀ)⁻¹ b from the factorisation of A by the Woodbury formula:
///   y − A⁻¹U (1 + Uᵀ A⁻¹U)⁻¹ Uᵀy with y = A⁻¹b
/// It solves one linear system for b and one for each column of U. U may have no columns. The relative error in the
/// space that the columns of U span is about ε |U Uᵀ|/|A|, where |A| is the norm of A in this space and ε = 2⁻⁵². If
/// this error is too large, factorise the sum A + U Uᵀ instead.
Eigen::VectorXd solve_updated(const BlockCholesky& factor, const Eigen::MatrixXd& u, const Eigen::VectorXd& b);

}  // namespace isojam
