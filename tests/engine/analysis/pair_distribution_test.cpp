#include "engine/analysis/pair_distribution.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <stdexcept>

#include "engine/geometry/convex_solid.hpp"

namespace isojam {
namespace {

using Eigen::Vector3d;

/// A packing of cubes whose centres are on a simple cubic lattice with 4³ sites of spacing `spacing`.
Packing lattice(double spacing, const Vector3d& shift = Vector3d::Zero()) {
  RandomStream random({1, 1});
  Packing packing = random_packing(platonic(SolidKind::cube), 64, 1 / (spacing * spacing * spacing), random);
  for (int k = 0; k < 64; ++k) {
    const int z = k / 16;
    packing.poses[static_cast<std::size_t>(k)] = {spacing * Vector3d(k % 4, k / 4 % 4, z) + shift};
  }
  return packing;
}

double shell(double inner, double width) {
  return 4 * std::numbers::pi / 3 * (std::pow(inner + width, 3) - std::pow(inner, 3));
}

TEST(PairDistribution, HasThePeaksOfALattice) {
  const double spacing = 1.53, width = 0.1, density = 1 / (spacing * spacing * spacing);
  const auto g = pair_distribution(lattice(spacing), width, 10);
  ASSERT_EQ(g.size(), 30U) << "half of the side 6.12";
  double others = 0;
  for (std::size_t k = 0; k < g.size(); ++k) {
    const double neighbours = g[k] * density * shell(width * static_cast<double>(k), width);
    if (k == 15) {
      EXPECT_NEAR(neighbours, 6, 1e-10);  // r = 1.53
    } else if (k == 21) {
      EXPECT_NEAR(neighbours, 12, 1e-10);  // r = 2.16
    } else if (k == 26) {
      EXPECT_NEAR(neighbours, 8, 1e-10);  // r = 2.65
    } else {
      others += neighbours;
    }
  }
  EXPECT_EQ(others, 0);
  const auto moved = pair_distribution(lattice(spacing, {5, -9, 0.2}), width, 10);
  for (std::size_t k = 0; k < g.size(); ++k) EXPECT_NEAR(moved[k], g[k], 1e-9) << k;
  EXPECT_EQ(pair_distribution(lattice(spacing), width, 2).size(), 20U);
}

TEST(PairDistribution, AgreesWithASearchOverImagesInASkewCell) {
  RandomStream random({5, 1});
  DoubleDoubleMatrix shear;
  shear.high(0, 1) = 0.4;
  shear.high(2, 2) = 0.8;
  const Packing packing = deformed(random_packing(platonic(SolidKind::cube), 60, 0.4, random), shear);
  const double width = 0.2, end = packing.cell.shortest_translation() / 2;
  const auto g = pair_distribution(packing, width, 100);
  ASSERT_EQ(g.size(), static_cast<std::size_t>(end / width));
  std::vector<double> pairs(g.size(), 0);
  for (const auto& a : packing.poses) {
    for (const auto& b : packing.poses) {
      for (int image = 0; image < 343; ++image) {
        const Eigen::Vector3i shift(image % 7 - 3, image / 7 % 7 - 3, image / 49 - 3);
        const double r = (b.position - a.position + packing.cell.translation(shift)).norm();
        const auto bin = static_cast<std::size_t>(r / width);
        if (r > 0 && bin < pairs.size()) ++pairs[bin];
      }
    }
  }
  for (std::size_t k = 0; k < g.size(); ++k) {
    const double ideal = 60 * 60 * shell(width * static_cast<double>(k), width) / packing.cell.volume();
    EXPECT_NEAR(g[k], pairs[k] / ideal, 1e-9) << k;
  }
}

TEST(PairDistribution, RejectsAWidthThatIsNotPositive) {
  EXPECT_THROW(pair_distribution(lattice(1.53), 0, 1), std::invalid_argument);
}

}  // namespace
}  // namespace isojam
