#include "engine/solve/factor/incomplete_cholesky.hpp"

#include "engine/solve/factor/definite_solver.hpp"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cstdio>

#include "tests/engine/solve/scattered_blocks.hpp"

namespace isojam {
namespace {

Eigen::MatrixXd dense(const BlockMatrix& matrix, double shift) {
  const Eigen::Index n = matrix.rows();
  Eigen::MatrixXd all(n, n);
  for (Eigen::Index k = 0; k < n; ++k) all.col(k) = matrix * Eigen::VectorXd(Eigen::VectorXd::Unit(n, k));
  return all + shift * Eigen::MatrixXd::Identity(n, n);
}

/// P⁻¹ as a matrix.
Eigen::MatrixXd inverse(const IncompleteCholesky& preconditioner, Eigen::Index n) {
  Eigen::MatrixXd all(n, n);
  for (Eigen::Index k = 0; k < n; ++k) all.col(k) = preconditioner.solve(Eigen::VectorXd::Unit(n, k));
  return all;
}

double condition(const Eigen::VectorXd& eigenvalues) { return eigenvalues.maxCoeff() / eigenvalues.minCoeff(); }

TEST(IncompleteCholesky, IsExactForAChain) {
  BlockMatrix matrix = scattered_blocks(30, 5);
  std::erase_if(matrix.off_diagonal, [](const BlockMatrix::Block& block) { return block.column != block.row + 1; });
  for (int k = 0; k + 1 < 30; k += 2) {
    if (std::none_of(matrix.off_diagonal.begin(), matrix.off_diagonal.end(), [&](const auto& b) { return b.row == k; }))
      matrix.off_diagonal.push_back({k, k + 1, Matrix6d::Constant(0.3)});
  }
  std::sort(matrix.off_diagonal.begin(), matrix.off_diagonal.end(),
            [](const auto& one, const auto& other) { return one.row < other.row; });
  for (const double scale : {1.0, 1e-18}) {
    BlockMatrix scaled = matrix;
    for (Matrix6d& block : scaled.diagonal) block *= scale;
    for (BlockMatrix::Block& block : scaled.off_diagonal) block.value *= scale;
    IncompleteCholesky preconditioner;
    ASSERT_TRUE(preconditioner.factorise(scaled, safe_shift * scale));
    const Eigen::MatrixXd product = inverse(preconditioner, matrix.rows()) * dense(scaled, safe_shift * scale);
    const double error = (product - Eigen::MatrixXd::Identity(matrix.rows(), matrix.rows())).lpNorm<Eigen::Infinity>();
    std::printf("chain of 30, scale %.0e: largest error of P⁻¹(H + λ·1) − 1: %.1e\n", scale, error);
    EXPECT_LT(error, 1e-5);
  }
}

TEST(IncompleteCholesky, ImprovesTheConditionOfSparseMatrices) {
  for (const int n : {20, 50}) {
    const BlockMatrix matrix = scattered_blocks(n, 7);
    const double shift = 0.7 * safe_shift;
    IncompleteCholesky preconditioner;
    ASSERT_TRUE(preconditioner.factorise(matrix, shift));
    const Eigen::MatrixXd p = inverse(preconditioner, matrix.rows()), a = dense(matrix, shift);
    const double asymmetry = (p - p.transpose()).norm() / p.norm();
    // P⁻¹A has the eigenvalues of Lᵀ A L with P⁻¹ = L Lᵀ.
    const Eigen::LLT<Eigen::MatrixXd> root((p + p.transpose()) / 2);
    ASSERT_EQ(root.info(), Eigen::Success) << "P is not positive definite";
    const Eigen::MatrixXd l = root.matrixL();
    const double before = condition(Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(a).eigenvalues());
    const double after = condition(Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(l.transpose() * a * l).eigenvalues());
    std::printf("N = %d: asymmetry %.1e, condition %.1f, with preconditioner %.2f\n", n, asymmetry, before, after);
    EXPECT_LT(asymmetry, 1e-5);
    EXPECT_LT(after, before / 2);
  }
}

TEST(IncompleteCholesky, RefusesANegativePivot) {
  BlockMatrix matrix = scattered_blocks(10, 3);
  IncompleteCholesky preconditioner;
  EXPECT_TRUE(preconditioner.factorise(matrix, safe_shift));
  matrix.diagonal[4](2, 2) = -2 * safe_shift;
  EXPECT_FALSE(preconditioner.factorise(matrix, safe_shift));
}

TEST(DefiniteSolver, IteratesInLargeSystems) {
  for (const int n : {100, 800}) {
    const BlockMatrix matrix = scattered_blocks(n, 9);
    const double shift = 0.8 * safe_shift;
    RandomStream random{10};
    Eigen::VectorXd exact(matrix.rows());
    for (double& x : exact) x = random.uniform() - 0.5;
    const Eigen::VectorXd b = matrix * exact + shift * exact;
    MinimiseWork work;
    BlockCholesky complete;
    const auto found = DefiniteSolver(complete).solve(matrix, shift, b, 1e-6, work);
    ASSERT_TRUE(found);
    std::printf("N = %d: error %.1e, %ld complete factorisations, %ld iterations\n", n,
                (*found - exact).norm() / exact.norm(), work.factorisations, work.krylov_vectors);
    EXPECT_LT((*found - exact).norm(), 1e-5 * exact.norm());
    EXPECT_EQ(work.factorisations, n < 600 ? 1 : 0);
    EXPECT_LT(work.krylov_vectors, 30);
  }
}

TEST(DefiniteSolver, ReportsNegativeCurvature) {
  const BlockMatrix matrix = scattered_blocks(800, 9);
  Eigen::VectorXd b = Eigen::VectorXd::Ones(matrix.rows());
  MinimiseWork work;
  BlockCholesky complete;
  EXPECT_FALSE(DefiniteSolver(complete).solve(matrix, 0, b, 1e-6, work)) << "the lowest eigenvalue is about -4";
  IncompleteCholesky preconditioner;
  ASSERT_TRUE(preconditioner.factorise(matrix, safe_shift));
  const IterativeSolution cut = conjugate_gradients(matrix, safe_shift, preconditioner, b, 1e-12, 2);
  EXPECT_EQ(cut.end, IterativeSolution::End::not_converged);
  EXPECT_EQ(cut.iterations, 2);
}

}  // namespace
}  // namespace isojam
