#include "engine/packing/incipient_contact.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <tuple>

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
  packing.poses[1].orientation = rotated(packing.poses[1].orientation, tilt);
  return packing;
}

VectorXd approach(double distance) {
  VectorXd step = VectorXd::Zero(12);
  step[6] = -distance;
  return step;
}

std::tuple<int, int> key(const IncipientContact& pair) { return {pair.a, pair.b}; }

TEST(IncipientContactTest, ProbingAddsPairs) {
  for (const Packing& packing : samples(51, 100, .6)) {
    PackingEnergy energy;
    const long contacts = energy.evaluate(packing).contacts;
    const double probe_distance = 0.02 * packing.solids.only().inradius();
    const std::vector<IncipientContact> now = energy.second_order(packing, 0).pairs;
    const std::vector<IncipientContact> probed = energy.second_order(packing, probe_distance).pairs;
    EXPECT_EQ(static_cast<long>(now.size()), contacts) << describe(packing);
    EXPECT_GT(probed.size(), now.size()) << describe(packing);
    EXPECT_TRUE(
        std::is_sorted(probed.begin(), probed.end(), [](const auto& p, const auto& q) { return key(p) < key(q); }));
    std::size_t matched = 0;
    for (const IncipientContact& pair : probed) {
      if (matched < now.size() && key(now[matched]) == key(pair) && pair.now.at_rest > 0) {
        ++matched;
        continue;
      }
      const Vector3d r = packing.cell.nearest_image(packing.poses[pair.b].position - packing.poses[pair.a].position);
      EXPECT_EQ(volume_at(packing.solids.only(), packing, pair, Vector3d::Zero()), 0) << pair.a << ' ' << pair.b;
      EXPECT_GT(volume_at(packing.solids.only(), packing, pair, -probe_distance * r.normalized()), 0)
          << pair.a << ' ' << pair.b;
    }
    EXPECT_EQ(matched, now.size()) << describe(packing);
  }
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

TEST(IncipientContactTest, VolumeLiesAboveTheTangentsOfAFlatContact) {
  RandomStream random{53};
  for (int k = 0; k < 200; ++k) {
    const double depth = 1e-6, size = std::pow(10, -8 + 3 * random.uniform());
    const Packing packing = two_cubes(-depth, size * Vector3d(0, random.normal(), random.normal()));
    const std::vector<IncipientContact> pairs = PackingEnergy().second_order(packing, 5 * size).pairs;
    ASSERT_EQ(pairs.size(), 1u);
    VectorXd step = approach(size * random.normal());
    for (int axis = 1; axis < 3; ++axis) step[9 + axis] = size * random.normal();
    const double volume = volume_at(cube(), moved(packing, step), pairs[0], Vector3d::Zero());
    // The tangents are linear in the small lengths. The motions of solids are not: they differ by products of two
    // lengths.
    const double slack = 10 * std::pow(depth + size + step.norm(), 2);
    EXPECT_GE(volume, pairs[0].now.at(step, 0, 1) - slack) << "size " << size;
    EXPECT_GE(volume, pairs[0].closed.at(step, 0, 1) - slack) << "size " << size;
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
