// Facts proved here:
//   the product of a block matrix with a vector is that of the full symmetric matrix;
//   stiffened() adds factor·Σ tilts: a positive semidefinite term, linear in the factor, that resists relative turns
//   only and is blind to translations and to equal turns of all particles; also for the tilts of real packings.

#include "engine/packing/block_matrix.hpp"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>

#include "tests/engine/packing/packings.hpp"

namespace isojam {
namespace {

using namespace testing_packings;
using Eigen::MatrixXd;
using Eigen::VectorXd;

template <int rows>
Eigen::Matrix<double, rows, rows> random_matrix(RandomStream& random) {
  Eigen::Matrix<double, rows, rows> m;
  for (double& x : m.reshaped()) x = random.normal();
  return m;
}

BlockMatrix random_block_matrix(RandomStream& random, int n) {
  BlockMatrix matrix;
  for (int i = 0; i < n; ++i) {
    const Matrix6d m = random_matrix<6>(random);
    matrix.diagonal.push_back(m + m.transpose());
    for (int j = i + 1; j < n; ++j) {
      if (random.uniform() < .4) matrix.off_diagonal.push_back({i, j, random_matrix<6>(random)});
    }
  }
  return matrix;
}

TEST(BlockMatrixTest, ProductIsThatOfTheFullMatrix) {
  RandomStream random{9, 1};
  for (int n = 1; n < 12; ++n) {
    const BlockMatrix matrix = random_block_matrix(random, n);
    const VectorXd x = random_step(random, n);
    const MatrixXd full = dense(matrix);
    EXPECT_EQ(matrix.size(), n);
    EXPECT_EQ((full - full.transpose()).norm(), 0) << "N " << n;
    EXPECT_LE((matrix * x - full * x).norm(), 8 * epsilon * full.norm() * x.norm()) << "N " << n;
  }
}

/// The term that stiffened() adds is what the tilts say.
void check_stiffening(const BlockMatrix& matrix, const std::vector<TiltStiffness>& tilts) {
  const MatrixXd added = dense(stiffened(matrix, tilts, 1.5)) - dense(matrix);
  const double rounding = 64 * epsilon * (dense(matrix).norm() + added.norm());
  ASSERT_GT(added.norm(), rounding);
  EXPECT_LE((added - added.transpose()).norm(), rounding);
  const VectorXd eigenvalues = Eigen::SelfAdjointEigenSolver<MatrixXd>(added, Eigen::EigenvaluesOnly).eigenvalues();
  EXPECT_GE(eigenvalues.minCoeff(), -rounding);

  RandomStream random{9, 2};
  const VectorXd x = random_step(random, matrix.size());
  double quadratic = 0;
  for (const TiltStiffness& tilt : tilts) {
    const BlockMatrix::Block& block = matrix.off_diagonal[tilt.block];
    const Eigen::Vector3d relative = x.segment<3>(6 * block.column + 3) - x.segment<3>(6 * block.row + 3);
    quadratic += 1.5 * relative.dot(tilt.value * relative);
  }
  EXPECT_NEAR(x.dot(added * x), quadratic, rounding * x.squaredNorm());

  VectorXd rigid(6 * matrix.size());
  for (int i = 0; i < matrix.size(); ++i) rigid.segment<6>(6 * i) << x.segment<3>(6 * i), 1, -2, 3;
  EXPECT_LE((added * rigid).norm(), rounding * rigid.norm());

  const MatrixXd twice = dense(stiffened(matrix, tilts, 3)) - dense(matrix);
  EXPECT_LE((twice - 2 * added).norm(), 4 * rounding);
  EXPECT_EQ((dense(stiffened(matrix, tilts, 0)) - dense(matrix)).norm(), 0);
}

TEST(StiffenedTest, AddsAPositiveSemidefiniteTerm) {
  RandomStream random{9, 3};
  for (int n = 2; n < 10; ++n) {
    BlockMatrix matrix = random_block_matrix(random, n);
    if (matrix.off_diagonal.empty()) matrix.off_diagonal.push_back({0, 1, random_matrix<6>(random)});
    std::vector<TiltStiffness> tilts;
    for (int k = 0; k < static_cast<int>(matrix.off_diagonal.size()); ++k) {
      const Eigen::Matrix3d m = random_matrix<3>(random);
      tilts.push_back({k, m * m.transpose()});
      if (k % 3 == 0) tilts.push_back({k, m.transpose() * m});  // two contacts of one pair
    }
    check_stiffening(matrix, tilts);
  }
}

TEST(StiffenedTest, TiltsOfPackingsArePositiveSemidefinite) {
  for (const Packing& packing : samples(10, 70, .6)) {
    const SecondOrder second = PackingEnergy().second_order(packing);
    check_stiffening(second.hessian, second.tilts);
  }
}

}  // namespace
}  // namespace isojam
