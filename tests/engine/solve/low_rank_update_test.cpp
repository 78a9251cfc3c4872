#include "engine/solve/factor/low_rank_update.hpp"

#include <Eigen/Cholesky>
#include <limits>

#include "engine/solve/factor/dense.hpp"
#include "tests/engine/solve/solve_support.hpp"

namespace isojam {
namespace {

TEST(LowRankUpdate, SolvesAsTheFactorsOfTheSumDo) {
  constexpr double eps = std::numeric_limits<double>::epsilon();
  RandomStream random{91};
  for (const SolidKind kind : all_solids) {
    const Packing packing = small_packing(kind, 0.8, 37);
    PackingEnergy energy;
    const BlockMatrix hessian = energy.hessian(packing);
    const Eigen::MatrixXd full = dense(hessian);
    const double stiffness = full.diagonal().maxCoeff();
    double shift = stiffness;
    BlockCholesky factor;
    while (!factor.factorise(hessian, shift)) shift *= 2;
    for (const int columns : {0, 1, 2, 5, 12}) {
      for (const double stiffer : {1e-3, 1.0, 1e3}) {
        Eigen::MatrixXd u = Eigen::MatrixXd::Zero(full.rows(), columns);
        for (int c = 0; c < columns; ++c) {
          for (int k = 0; k < 12; ++k) {
            const auto row = static_cast<Eigen::Index>(random.uniform() * static_cast<double>(u.rows()));
            u(row, c) = std::sqrt(stiffer * stiffness) * random.normal();
          }
        }
        Eigen::VectorXd b(full.rows());
        for (double& x : b) x = random.normal();
        const Eigen::MatrixXd sum =
            full + shift * Eigen::MatrixXd::Identity(full.rows(), full.cols()) + u * u.transpose();
        const Eigen::VectorXd expected = sum.llt().solve(b), found = solve_updated(factor, u, b);
        const Eigen::VectorXd values = symmetric_eigenvalues(sum);
        const double condition = values.maxCoeff() / values.minCoeff();
        EXPECT_LE((found - expected).norm(), 100 * eps * condition * expected.norm())
            << platonic(kind).name() << ", " << columns << " columns, " << stiffer << ", condition " << condition;
      }
    }
  }
}

}  // namespace
}  // namespace isojam
