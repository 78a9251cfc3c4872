#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <optional>

namespace isojam {

/// The f that makes objective·f greatest among f ≥ 0 with columns·f = 0 and Σf = 1, by the simplex method; nullopt if
/// there is no such f, or none was found.
std::optional<Eigen::VectorXd> greatest(const Eigen::SparseMatrix<double>& columns, const Eigen::VectorXd& objective);

}  // namespace isojam
