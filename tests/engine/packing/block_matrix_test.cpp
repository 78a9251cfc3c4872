#include "engine/packing/block_matrix.hpp"

#include <gtest/gtest.h>

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
    matrix.diagonal.emplace_back(m + m.transpose());
    for (int j = i + 1; j < n; ++j) {
      if (random.uniform() < .4) matrix.off_diagonal.push_back({i, j, random_matrix<6>(random)});
    }
  }
  return matrix;
}

TEST(BlockMatrixTest, ProductAgreesWithTheFullMatrix) {
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

}  // namespace
}  // namespace isojam
