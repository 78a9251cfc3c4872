#include "engine/packing/incipient_contact.hpp"

#include <gtest/gtest.h>

#include "tests/engine/packing/packings.hpp"

namespace isojam {
namespace {

using namespace testing_packings;
using Eigen::Vector3d;
using Eigen::VectorXd;

const ConvexSolid& cube() { return platonic(SolidKind::cube); }

double volume_at(const ConvexSolid& solid, const Packing& packing, const IncipientContact& pair,
                 const Vector3d& shift) {
  const Pose &a = packing.poses[pair.a], &b = packing.poses[pair.b];
  const Vector3d r = packing.cell.nearest_image(b.position - a.position) + shift;
  return relative_overlap(solid, solid, relative_pose(a.orientation, b.orientation, r)).volume;
}

/// Two unit cubes face to face along x, `gap` apart. The cell is so large that periodic images do not matter.
Packing two_cubes(double gap, const Vector3d& tilt = Vector3d::Zero()) {
  Packing packing{cube(), PeriodicCell(10), std::vector<Pose>(2)};
  packing.poses[0].position = Vector3d(4, 5, 5);
  packing.poses[1].position = Vector3d(5 + gap, 5, 5);
  packing.poses[1] = moved(packing.poses[1], Vector3d::Zero(), tilt);
  return packing;
}

VectorXd approach(double distance) {
  VectorXd step = VectorXd::Zero(12);
  step[6] = -distance;
  return step;
}

/// Largest difference between V and a tangent, divided by the slope, along a random direction. Both tangents are
/// tested.
TEST(IncipientContactTest, BothAreTangents) {
  RandomStream random{52};
  for (const Packing& packing : samples(52, 100, .65)) {
    const double probe_distance = 0.01 * packing.solids.only().inradius(), h = 1e-6;
    const VectorXd direction = random_step(random, packing.size());
    const Packing ahead = moved(packing, h * direction), behind = moved(packing, -h * direction);
    PackingEnergy energy;
    int checked = 0;
    for (const IncipientContact& pair : energy.second_order(packing, probe_distance).pairs) {
      const Vector3d r = packing.cell.nearest_image(packing.poses[pair.b].position - packing.poses[pair.a].position);
      for (const bool closed : {false, true}) {
        const LinearisedOverlap& tangent = closed ? pair.closed : pair.now;
        if (!(tangent.at_rest > 1e-5)) continue;  // deep enough for differences with step h
        const Vector3d shift = closed ? Vector3d(-probe_distance * r.normalized()) : Vector3d::Zero();
        const double difference = (volume_at(packing.solids.only(), ahead, pair, shift) -
                                   volume_at(packing.solids.only(), behind, pair, shift)) /
                                  (2 * h);
        const double slope = tangent.at(direction, pair.a, pair.b) - tangent.at_rest;
        const double scale = direction.norm() * (tangent.slope_a.norm() + tangent.slope_b.norm());
        EXPECT_NEAR(slope, difference, 1e-6 * scale) << describe(packing) << (closed ? " closed" : " now");
        ++checked;
      }
    }
    EXPECT_GT(checked, 50) << describe(packing);
  }
}

TEST(IncipientContactTest, AGapIsANegativeVolume) {
  for (const double gap : {1e-9, 1e-6, 1e-4}) {
    const Packing packing = two_cubes(gap);
    PackingEnergy energy;
    ASSERT_EQ(energy.evaluate(packing).contacts, 0);
    const std::vector<IncipientContact> pairs = energy.second_order(packing, 3 * gap).pairs;
    ASSERT_EQ(pairs.size(), 1u) << "gap " << gap;
    const double rounding = 64 * epsilon;
    EXPECT_EQ(pairs[0].now.at_rest, 0);
    EXPECT_NEAR(pairs[0].closed.at_rest, -gap, rounding);
    EXPECT_NEAR(pairs[0].closed.at(approach(gap), 0, 1), 0, rounding);
    EXPECT_NEAR(pairs[0].closed.at(approach(5 * gap), 0, 1), 4 * gap, rounding);
  }
}

TEST(IncipientContactTest, ACornerOfAFaceHasTheTiltStiffnessOfTheFace) {
  const double tilt = 1e-5;
  // The far edge of B's face is higher than its middle by `tilt`. The near edge overlaps by a hundredth of this.
  const Packing packing = two_cubes(tilt / 2 * 0.99, Vector3d(0, 0, tilt));
  const IncipientContact touching = PackingEnergy().second_order(packing, 0).pairs.at(0);
  const IncipientContact probed = PackingEnergy().second_order(packing, 2 * tilt).pairs.at(0);
  const IncipientContact flat = PackingEnergy().second_order(two_cubes(-tilt), 0).pairs.at(0);
  ASSERT_GT(touching.now.at_rest, 0);
  EXPECT_LT(touching.tilt.trace(), 1e-3 * flat.tilt.trace());
  EXPECT_NEAR(probed.tilt.trace(), flat.tilt.trace(), 0.01 * flat.tilt.trace());
  const double rounding = 64 * epsilon * flat.tilt.trace();
  EXPECT_LE((flat.tilt * Vector3d::UnitX()).norm(), rounding);
  for (double angle = 0; angle < 3; angle += 0.3) {
    const Vector3d axis(0, std::cos(angle), std::sin(angle));
    EXPECT_NEAR(axis.dot(flat.tilt * axis), flat.tilt.trace() / 2, rounding) << "angle " << angle;
  }
}

}  // namespace
}  // namespace isojam
