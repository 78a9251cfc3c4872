#include "engine/solve/factor/low_rank_update.hpp"

#include "engine/solve/factor/dense.hpp"

namespace isojam {

Eigen::VectorXd solve_updated(const BlockCholesky& factor, const Eigen::MatrixXd& u, const Eigen::VectorXd& b) {
  const Eigen::VectorXd y = factor.solve(b);
  Eigen::MatrixXd w(u.rows(), u.cols());
  for (Eigen::Index k = 0; k < u.cols(); ++k) w.col(k) = factor.solve(u.col(k));
  const Eigen::MatrixXd inner = Eigen::MatrixXd::Identity(u.cols(), u.cols()) + u.transpose() * w;
  return y - w * solve_positive_definite(inner, u.transpose() * y);
}

}  // namespace isojam
