#include "engine/analysis/order.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "engine/geometry/convex_solid.hpp"
#include "engine/random/stream.hpp"

namespace isojam {
namespace {

using Bonds = std::vector<Eigen::Vector3d>;

Bonds face_centred() {
  Bonds bonds;
  for (int axis = 0; axis < 3; ++axis) {
    for (const double s : {-1.0, 1.0}) {
      Eigen::Vector3d bond = Eigen::Vector3d::Ones();
      bond[axis] = 0;
      bond[(axis + 1) % 3] = s;
      bonds.push_back(bond);
    }
  }
  return bonds;
}

TEST(SteinhardtOrder, OfKnownShells) {
  const Bonds cubic{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  EXPECT_NEAR(steinhardt_order(cubic, 4), std::sqrt(7.0 / 12), 1e-14);
  EXPECT_NEAR(steinhardt_order(cubic, 6), std::sqrt(1.0 / 8), 1e-14);
  EXPECT_NEAR(steinhardt_order(face_centred(), 4), std::sqrt(7.0 / 192), 1e-14);
  EXPECT_NEAR(steinhardt_order(face_centred(), 6), std::sqrt(169.0 / 512), 1e-14);
  const Bonds& icosahedral = platonic(SolidKind::icosahedron).vertices();
  EXPECT_NEAR(steinhardt_order(icosahedral, 4), 0, 1e-7);
  EXPECT_NEAR(steinhardt_order(icosahedral, 6), std::sqrt(11.0) / 5, 1e-13);
}

TEST(SteinhardtOrder, OfParallelBondsAndOfNone) {
  const Bonds parallel{{1, 2, 3}, {-2, -4, -6}, {0.1, 0.2, 0.3}};
  EXPECT_NEAR(steinhardt_order(parallel, 6), 1, 1e-14);
  EXPECT_EQ(steinhardt_order(Bonds{}, 6), 0);
}

}  // namespace
}  // namespace isojam
