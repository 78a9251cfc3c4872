#include "engine/analysis/gaps.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <cstdio>
#include <stdexcept>

#include "engine/geometry/overlap/separating_axis.hpp"
#include "engine/packing/energy.hpp"
#include "tests/engine/analysis/constructed_contacts.hpp"
#include "tests/engine/solve/solve_support.hpp"

namespace isojam {
namespace {

using Eigen::Vector3d;

TEST(GapsTest, AgreeWithASearchOverAllPairs) {
  for (const SolidKind kind : all_solids) {
    const Packing packing = small_packing(kind, .55, 41);
    const auto gaps = near_gaps(packing, .1);
    std::vector<Gap> expected;
    // All pairs whose centres are closer than two diameters.
    for (const auto& pair : find_neighbours_brute_force(packing, 2 * platonic(kind).diameter())) {
      const auto &a = packing.poses[static_cast<std::size_t>(pair.a)],
                 &b = packing.poses[static_cast<std::size_t>(pair.b)];
      const Eigen::Matrix3d to_a = a.orientation.toRotationMatrix().transpose();
      const RelativePose pose{to_a * b.orientation.toRotationMatrix(), to_a * displacement(packing, pair)};
      const double width = gap(platonic(kind), platonic(kind), pose, best_axis(platonic(kind), platonic(kind), pose));
      if (width > 0 && width < .1) expected.push_back({pair, width});
    }
    ASSERT_EQ(gaps.size(), expected.size()) << to_string(kind);
    ASSERT_GE(gaps.size(), 3U);
    for (std::size_t k = 0; k < gaps.size(); ++k) {
      EXPECT_EQ(canonical_key(gaps[k].pair), canonical_key(expected[k].pair));
      EXPECT_NEAR(gaps[k].width, expected[k].width, 1e-14);
    }
    for (const Contact& contact : PackingEnergy().contacts(packing)) {
      for (const Gap& one : gaps) EXPECT_NE(canonical_key(one.pair), canonical_key(contact.pair));
    }
  }
}

TEST(GapsTest, IncludePairsWhoseSpheresAreFartherApart) {
  constexpr double sphere_gap = 0.1;
  const ConvexSolid& cube = platonic(SolidKind::cube);
  Packing packing{cube, PeriodicCell(100), std::vector<Pose>(2)};
  // Two cubes with the same orientation, with the vertices (1, 1, 1)/2 and −(1, 1, 1)/2 facing each other.
  packing.poses[1].position = (2 * cube.circumradius() + sphere_gap) * Vector3d::Ones().normalized();
  const double width = sphere_gap / std::sqrt(3);
  const auto gaps = near_gaps(packing, 1.01 * width);
  ASSERT_EQ(gaps.size(), 1U);
  EXPECT_NEAR(gaps[0].width, width, 1e-14);
  EXPECT_TRUE(gaps[0].of_faces);
  EXPECT_EQ(near_gaps(packing, 0.99 * width).size(), 0U);
}

TEST(GapsTest, OfRandomPairsWithVerticesThatFaceEachOther) {
  constexpr double max_width = 0.1;
  RandomStream random{43};
  int beyond = 0;
  for (const SolidKind kind : all_solids) {
    const ConvexSolid& solid = platonic(kind);
    const Vector3d vertex = solid.vertices().front();
    int found = 0;
    for (int k = 0; k < 200; ++k) {
      Packing packing{solid, PeriodicCell(100), std::vector<Pose>(2)};
      const double sphere_gap = 4 * max_width * random.uniform();
      packing.poses[1].position = (2 * solid.circumradius() + sphere_gap) * vertex.normalized();
      const Vector3d tilt = 0.05 * Vector3d(random.uniform() - 0.5, random.uniform() - 0.5, random.uniform() - 0.5);
      const auto facing = Eigen::Quaterniond::FromTwoVectors(vertex, -vertex);
      const Eigen::AngleAxisd spin(6 * random.uniform(), vertex.normalized());
      packing.poses[1].orientation = Eigen::Quaterniond(1, tilt.x(), tilt.y(), tilt.z()).normalized() * spin * facing;
      const auto &a = packing.poses[0], &b = packing.poses[1];
      const RelativePose pose = relative_pose(a.orientation, b.orientation, b.position - a.position);
      const double width = gap(solid, solid, pose, best_axis(solid, solid, pose));
      const bool expected = width > 0 && width < max_width;
      EXPECT_EQ(near_gaps(packing, max_width).size(), expected ? 1U : 0U) << to_string(kind) << ", width " << width;
      found += expected;
      beyond += expected && sphere_gap > max_width;
    }
    std::printf("%s: %d of 200 pairs have a width below %.1f\n", to_string(kind).data(), found, max_width);
  }
  EXPECT_GE(beyond, 1) << "no pair has a smaller width than the gap of its spheres: choose another seed";
}

/// Checks the gap of two bodies at a distance h, and the gap with the bodies exchanged.
void expect_gap(const ConvexSolid& solid, const Contact& apart, double h, bool of_faces) {
  for (const bool exchanged : {false, true}) {
    const RelativePose& pose = apart.pose;
    Packing packing{solid, PeriodicCell(100), std::vector<Pose>(2)};
    packing.poses[exchanged ? 0 : 1].position = pose.displacement;
    packing.poses[exchanged ? 0 : 1].orientation = Eigen::Quaterniond(pose.rotation);
    const auto gaps = near_gaps(packing, .1);
    ASSERT_EQ(gaps.size(), 1U);
    EXPECT_NEAR(gaps[0].width, h, 1e-14);
    EXPECT_EQ(gaps[0].of_faces, of_faces);
  }
}

TEST(GapsTest, OfConstructedPairsAreTheirDistance) {
  RandomStream random{42};
  for (const SolidKind kind : all_solids) {
    const ConvexSolid& solid = platonic(kind);
    for (const double h : {1e-9, 1e-5, 1e-2}) {
      const double spin = random.uniform();
      const auto face = constructed::face_site(solid, 1);
      const auto at = [&](const constructed::Site& a) {
        return constructed::contact(a, face, spin, Vector3d::Zero(), -h);
      };
      expect_gap(solid, at(constructed::vertex_site(solid, 0)), h, true);
      expect_gap(solid, at(constructed::edge_site(solid, 0)), h, true);
      expect_gap(solid, at(constructed::face_and_edges_site(solid, 0)), h, true);
      const auto edge = constructed::edge_site(solid, 0);
      expect_gap(solid, constructed::contact(edge, edge, 1, Vector3d::Zero(), -h), h, false);
    }
  }
  EXPECT_THROW(near_gaps(small_packing(SolidKind::cube, .3, 1), 0), std::invalid_argument);
}

}  // namespace
}  // namespace isojam
