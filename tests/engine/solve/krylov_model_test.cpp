// Reference: a dense eigenvalue decomposition.

#include "engine/solve/multipliers/krylov_model.hpp"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cmath>
#include <cstdio>
#include <limits>

#include "tests/engine/solve/scattered_blocks.hpp"

namespace isojam {
namespace {

constexpr double no_limit = std::numeric_limits<double>::infinity();

struct System {
  BlockMatrix matrix;
  Eigen::MatrixXd dense;
  Eigen::VectorXd gradient;
  IncompleteCholesky preconditioner;
};

/// M has the diagonal `diagonal`; below about 5, it is indefinite.
System random_system(int n, double diagonal, std::uint64_t seed) {
  System system{scattered_blocks(n, seed), {}, {}, {}};
  for (Matrix6d& block : system.matrix.diagonal) block.diagonal().array() += diagonal - 1;
  const Eigen::Index rows = system.matrix.rows();
  system.dense.resize(rows, rows);
  for (Eigen::Index k = 0; k < rows; ++k)
    system.dense.col(k) = system.matrix * Eigen::VectorXd(Eigen::VectorXd::Unit(rows, k));
  RandomStream random{seed, 99};
  system.gradient.resize(rows);
  for (double& x : system.gradient) x = random.uniform() - 0.5;
  EXPECT_TRUE(system.preconditioner.factorise(system.matrix, 2 * safe_shift));
  return system;
}

KrylovModel::Preconditioner inverse_of(const IncompleteCholesky& factor) {
  return [&](const Eigen::VectorXd& b) { return factor.solve(b); };
}

using Eigensolver = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>;

Eigen::VectorXd exact_step(const System& system, const Eigensolver& solver, double shift) {
  const Eigen::VectorXd slopes = solver.eigenvectors().transpose() * system.gradient;
  return -(solver.eigenvectors() * (slopes.array() / (solver.eigenvalues().array().abs() + shift)).matrix());
}

double decrease(const System& system, const Eigen::VectorXd& step) {
  return -system.gradient.dot(step) - step.dot(system.dense * step) / 2;
}

TEST(KrylovModel, IsExactInASmallSystem) {
  for (const double diagonal : {8.0, 1.0}) {
    const System system = random_system(3, diagonal, 11);
    const KrylovModel model(system.matrix, inverse_of(system.preconditioner), system.gradient, 1e-30);
    const Eigensolver solver(system.dense);
    const double lowest = solver.eigenvalues()[0];
    std::printf("diagonal %.0f: %d vectors, lowest eigenvalue %.3f of %.3f\n", diagonal, model.vectors(),
                model.lowest(), lowest);
    EXPECT_GE(model.lowest(), lowest - 1e-8);
    for (const double shift : {1.0, 10.0}) {
      const Eigen::VectorXd step = model.step(shift, no_limit).step, exact = exact_step(system, solver, shift);
      std::printf("  shift %.1f: error of the step %.1e\n", shift, (step - exact).norm() / exact.norm());
      EXPECT_LT((step - exact).norm(), 0.02 * exact.norm());
      EXPECT_NEAR(model.step(shift, no_limit).predicted_decrease, decrease(system, step),
                  1e-10 * std::abs(decrease(system, step)));
    }
  }
}

TEST(KrylovModel, NoParticleMovesFartherThanAllowed) {
  const System system = random_system(40, 2.0, 4);
  const KrylovModel model(system.matrix, inverse_of(system.preconditioner), system.gradient, 1e-3);
  for (const double longest : {1.0, 1e-2, 1e-4}) {
    const KrylovStep found = model.step(1e-3, longest);
    double moved = 0;
    for (int k = 0; k < 40; ++k)
      moved = std::max({moved, found.step.segment<3>(6 * k).norm(), found.step.segment<3>(6 * k + 3).norm()});
    std::printf("longest %.0e: moved %.2e with shift %.1e\n", longest, moved, found.shift);
    EXPECT_LE(moved, longest);
    EXPECT_GT(found.predicted_decrease, 0);
  }
}

TEST(KrylovModels, MeetIndefiniteMatrices) {
  for (const double diagonal : {8.0, 2.0, -1.0}) {
    const System system = random_system(30, diagonal, 5);
    const double lowest = Eigensolver(system.dense).eigenvalues()[0];
    BlockCholesky complete;
    KrylovModels models(1e-3, complete);
    MinimiseWork work;
    const auto model = models.model(system.matrix, system.gradient, 1e-3, work);
    ASSERT_TRUE(model);
    std::printf("lowest eigenvalue %.2f, in the space %.2f; %ld incomplete factorisations, %ld vectors\n", lowest,
                model->lowest(), work.incomplete_factorisations, work.krylov_vectors);
    EXPECT_EQ(work.krylov_vectors, model->vectors());
    EXPECT_GE(model->lowest(), lowest - 1e-9);
    EXPECT_LE(models.negative(), std::max(0.0, -lowest) + 1e-9);
    EXPECT_EQ(models.negative() > 0, lowest < 0);
  }
  System broken = random_system(10, 8.0, 6);
  broken.matrix.diagonal[3](1, 1) = std::numeric_limits<double>::quiet_NaN();
  MinimiseWork work;
  BlockCholesky complete;
  EXPECT_FALSE(KrylovModels(1.0, complete).model(broken.matrix, broken.gradient, 1, work));
}

}  // namespace
}  // namespace isojam
