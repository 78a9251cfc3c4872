#include "engine/packing/cell/strain.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "engine/geometry/quad.hpp"
#include "engine/packing/cell/control.hpp"
#include "engine/packing/cell/periodic_cell.hpp"
#include "engine/random/stream.hpp"

namespace isojam {
namespace {

Vector6d random_strain(RandomStream& random, double scale) {
  Vector6d strain;
  for (double& x : strain) x = scale * random.normal();
  return strain;
}

double difference(const QuadMatrix& a, const QuadMatrix& b) {
  double largest = 0;
  for (const Quad3& row : a - b) largest = std::max(largest, static_cast<double>(norm(row)));
  return largest;
}

Quad determinant(const QuadMatrix& m) { return dot(m[0], cross(m[1], m[2])); }

TEST(StrainTest, BasesAreOrthonormal) {
  for (const auto& entry : enum_names<CellFreedom>) {
    const StrainBasis basis = strain_basis(entry.value);
    const Eigen::Index n = basis.cols();
    EXPECT_LE((basis.transpose() * basis - Eigen::MatrixXd::Identity(n, n)).norm(), 1e-15) << entry.name;
    EXPECT_EQ(freedom_of(n), entry.value);
  }
  EXPECT_LE((traceless_basis().transpose() * trace_direction()).norm(), 1e-16);
}

TEST(StrainTest, ExponentialIsAccurateInDoubleDouble) {
  RandomStream random{31, 2};
  for (int k = 0; k < 100; ++k) {
    const double scale = std::pow(10, -3 * random.uniform()) / 8;
    const Eigen::Matrix3d strain = strain_tensor(random_strain(random, scale));
    const QuadMatrix once = widened(exponential(strain)), twice = widened(exponential(2 * strain));
    const QuadMatrix back = widened(exponential(-strain));
    const QuadMatrix identity = widened(DoubleDoubleMatrix{});
    EXPECT_LE(difference(once * once, twice), 1e-30) << scale;
    EXPECT_LE(difference(once * back, identity), 1e-30) << scale;
    const double trace = strain.trace();
    EXPECT_NEAR(static_cast<double>(determinant(once)), std::exp(trace), 1e-15 * std::exp(trace)) << scale;
  }
}

TEST(StrainTest, IsotropicStrainLeavesACubeACube) {
  PeriodicCell cell(5.125);
  for (const double strain : {1e-3, -2e-2, 3e-17, .2}) {
    cell = cell.deformed(exponential(strain * Eigen::Matrix3d::Identity()));
    EXPECT_TRUE(cell.is_cube()) << strain;
  }
  EXPECT_NEAR(cell.side(), 5.125 * std::exp(1e-3 - 2e-2 + .2), 1e-14);
  EXPECT_NE(cell.vectors().low(0, 0), 0);
}

}  // namespace
}  // namespace isojam
