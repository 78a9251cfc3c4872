// Facts proved here:
//   the nearest image lies in [−L/2, L/2) along each axis, is a whole number of sides away, is the shortest of all
//   images, and does not depend on the image it is taken of;
//   a cell has a finite positive side;
//   side_at gives the density; least_side is two diameters; least_particles is the least number whose cell is larger.

#include "engine/packing/periodic_cell.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>

#include "engine/random/stream.hpp"

namespace isojam {
namespace {

using Eigen::Vector3d;
using Eigen::Vector3i;

constexpr double epsilon = std::numeric_limits<double>::epsilon();

TEST(PeriodicCellTest, NearestImageIsTheShortest) {
  RandomStream random{6, 1};
  for (int k = 0; k < 1000; ++k) {
    const PeriodicCell cell(10 * std::exp(random.normal()));
    const double side = cell.side();
    Vector3d d;
    for (double& x : d) x = 3 * side * random.normal();
    const Vector3i shift = cell.nearest_shift(d);
    const Vector3d nearest = cell.nearest_image(d);
    const double rounding = 4 * epsilon * (d.norm() + side);
    EXPECT_LE((d + side * shift.cast<double>() - nearest).norm(), rounding) << d.transpose() << ", L " << side;
    for (const double x : nearest) {
      EXPECT_GE(x, -side / 2 - rounding) << d.transpose() << ", L " << side;
      EXPECT_LT(x, side / 2 + rounding) << d.transpose() << ", L " << side;
    }
    for (int image = 0; image < 27; ++image) {
      const int x = image % 3 - 1, y = image / 3 % 3 - 1, z = image / 9 - 1;
      const Vector3d away = side * Vector3d(x, y, z);
      EXPECT_LE(nearest.norm(), (nearest + away).norm() + rounding) << d.transpose() << ", L " << side;
      EXPECT_LE((cell.nearest_image(nearest + 2 * away) - nearest).norm(), rounding) << d.transpose() << ", L " << side;
    }
  }
}

TEST(PeriodicCellTest, HalfASideBelongsToTheLowerEnd) {
  const PeriodicCell cell(2);
  EXPECT_EQ(cell.nearest_shift(Vector3d(1, -1, 3)), Vector3i(-1, 0, -2));
  EXPECT_EQ(cell.nearest_image(Vector3d(1, -1, 3)), Vector3d(-1, -1, -1));
}

TEST(PeriodicCellTest, RefusesWhatIsNoSide) {
  for (const double side :
       {0.0, -1.0, std::numeric_limits<double>::infinity(), std::numeric_limits<double>::quiet_NaN()})
    EXPECT_THROW(PeriodicCell{side}, std::invalid_argument) << side;
}

TEST(PeriodicCellTest, SideGivesTheDensity) {
  RandomStream random{6, 2};
  for (int k = 0; k < 100; ++k) {
    const int n = 1 + static_cast<int>(5000 * random.uniform());
    const double density = .01 + .99 * random.uniform();
    const PeriodicCell cell(side_at(n, density));
    EXPECT_NEAR(n / cell.volume(), density, 8 * epsilon * density) << "N " << n;
  }
}

TEST(PeriodicCellTest, LeastParticlesIsTheLeast) {
  for (const SolidKind kind : all_solids) {
    const ConvexSolid& solid = platonic(kind);
    double diameter = 0;
    for (const Vector3d& v : solid.vertices()) {
      for (const Vector3d& w : solid.vertices()) diameter = std::max(diameter, (v - w).norm());
    }
    EXPECT_NEAR(least_side(solid), 2 * diameter, 8 * epsilon * diameter) << to_string(kind);
    for (const double density : {.01, .05, .3, .64, .7, .85, 1.0}) {
      const int n = least_particles(solid, density);
      EXPECT_GT(side_at(n, density), least_side(solid)) << to_string(kind) << ", φ " << density << ", N " << n;
      EXPECT_LE(side_at(n - 1, density), least_side(solid)) << to_string(kind) << ", φ " << density << ", N " << n;
    }
  }
}

}  // namespace
}  // namespace isojam
