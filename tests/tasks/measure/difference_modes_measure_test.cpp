#include <gtest/gtest.h>

#include "engine/solve/factor/dense.hpp"
#include "engine/vibration/dynamical_matrix.hpp"
#include "tasks/measure/measure.hpp"
#include "tests/tasks/support/packings.hpp"

namespace isojam {
namespace {

/// Octahedra with equal orientations on a cubic lattice: in equilibrium by symmetry, and unstable.
Packing lattice(int side, double density) {
  const int n = side * side * side;
  Packing packing{platonic(SolidKind::octahedron), PeriodicCell(std::cbrt(n / density)), {}};
  for (int k = 0; k < n; ++k) {
    const int x = k / (side * side), y = k / side % side, z = k % side;
    packing.poses.emplace_back();
    packing.poses.back().position = packing.cell.side() / side * Eigen::Vector3d(x, y, z);
  }
  return packing;
}

TEST(DifferenceModesMeasure, CountsAsADenseSolverDoes) {
  RandomStream random{19};
  const ConvexSolid& solid = platonic(SolidKind::icosahedron);
  const Packing drawn = random_packing(solid, least_particles(solid, 0.8), 0.8, random);
  long unstable = 0;
  for (const Packing& packing : {lattice(3, 0.3), drawn}) {
    const auto found = measure(Measure::difference_modes, test::single_state(packing)).states[0].at("difference_modes");
    const auto tolerance = found.at("tolerance").get<double>();
    const double modes = 6 * packing.size();
    const auto expect_count = [&](const Json& counted, const Eigen::MatrixXd& matrix) {
      const Eigen::VectorXd lambda = symmetric_eigenvalues(matrix);
      const auto negative = (lambda.array() < -tolerance).count();
      EXPECT_EQ(counted.at("negative").get<double>(), static_cast<double>(negative));
      EXPECT_EQ(counted.at("share").get<double>(), static_cast<double>(negative) / modes);
      unstable += negative;
    };
    expect_count(found.at("exact"), dense_matrix(PackingEnergy().hessian(packing, Precision::double_double)));
    for (const auto& [key, h] : {std::pair{"h4", 1e-4}, {"h6", 1e-6}, {"h8", 1e-8}}) {
      SCOPED_TRACE(key);
      EXPECT_EQ(found.at(key).at("h"), h);
      const Eigen::MatrixXd still = translations(PackingEnergy().hessian(packing));
      const Eigen::MatrixXd apart =
          Eigen::MatrixXd::Identity(6 * packing.size(), 6 * packing.size()) - still * still.transpose();
      const Eigen::MatrixXd matrix = apart * difference_hessian(packing, h, Precision::working) * apart;
      expect_count(found.at(key), matrix);
      EXPECT_NEAR(found.at(key).at("least").get<double>(), symmetric_eigenvalues(matrix)[0], 1e-12 * matrix.norm());
    }
  }
  EXPECT_GT(unstable, 0);
}

TEST(DifferenceModesMeasure, TooManyParticlesHaveNoValue) {
  const auto found =
      measure(Measure::difference_modes, test::single_state(lattice(8, 0.3))).states[0].at("difference_modes");
  for (const auto* key : {"exact", "h4", "h6", "h8"}) {
    EXPECT_TRUE(found.at(key).at("share").is_null()) << key;
    EXPECT_EQ(found.at(key).at("share_reason"), "more than 400 particles");
  }
}

}  // namespace
}  // namespace isojam
