#include "engine/geometry/overlap/penetration.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <numbers>

#include "engine/geometry/solids/solid.hpp"
#include "tests/engine/analysis/constructed_contacts.hpp"

namespace isojam {
namespace {

using Eigen::Vector3d;

constexpr double epsilon = 2.220446049250313e-16;

/// Checks the depth of the contact, and its depth with A and B exchanged.
void expect_depth(const ConvexSolid& solid, const Contact& contact, double depth) {
  const Contact other = constructed::exchanged(contact);
  for (const RelativePose& pose : {contact.pose, other.pose}) {
    const auto found = static_cast<double>(penetration(solid, solid, widened(pose)).depth);
    EXPECT_NEAR(found, depth, 16 * epsilon * solid.diameter()) << solid.name();
  }
}

TEST(Penetration, OfConstructedContactsIsTheDistanceOfThePush) {
  RandomStream random{17};
  const auto any = [&](std::size_t count) { return static_cast<int>(random.uniform() * static_cast<double>(count)); };
  for (const SolidKind kind : all_solids) {
    const ConvexSolid& solid = platonic(kind);
    for (int k = 0; k < 8; ++k) {
      const double depth = 1e-5 * random.uniform(), spin = 2 * std::numbers::pi * random.uniform();
      const auto vertex = constructed::vertex_site(solid, any(solid.vertices().size()));
      const auto face = constructed::face_site(solid, any(solid.faces().size()));
      const Vector3d none = Vector3d::Zero();
      expect_depth(solid, constructed::contact(vertex, face, spin, none, depth), depth);
      const auto edge = constructed::edge_site(solid, any(solid.edges().size()));
      const auto other_edge = constructed::edge_site(solid, any(solid.edges().size()));
      const double cross = std::numbers::pi * (.2 + .6 * random.uniform());
      expect_depth(solid, constructed::contact(edge, other_edge, cross, none, depth), depth);
    }
  }
}

/// Distance by which B must move along the unit vector u to be separated from A.
double way_along(const ConvexSolid& a, const ConvexSolid& b, const RelativePose& pose, const Vector3d& u) {
  double most_a = -a.diameter(), least_b = a.diameter() + b.diameter() + pose.displacement.norm();
  for (const Vector3d& v : a.vertices()) most_a = std::max(most_a, u.dot(v));
  for (const Vector3d& v : b.vertices()) least_b = std::min(least_b, u.dot(pose.rotation * v + pose.displacement));
  return most_a - least_b;
}

TEST(Penetration, NoDirectionSeparatesWithAShorterTranslation) {
  RandomStream random{18};
  for (const SolidKind kind : all_solids) {
    for (const SolidKind other : all_solids) {
      const ConvexSolid &a = platonic(kind), &b = platonic(other);
      RelativePose pose;
      pose.rotation = constructed::random_orientation(random).toRotationMatrix();
      pose.displacement = .9 * random.uniform() * (a.inradius() + b.inradius()) * constructed::random_direction(random);
      const auto depth = static_cast<double>(penetration(a, b, widened(pose)).depth);
      EXPECT_GT(depth, 0);
      for (int k = 0; k < 2000; ++k) {
        const Vector3d u = constructed::random_direction(random);
        ASSERT_LT(depth, way_along(a, b, pose, u) + 16 * epsilon * (a.diameter() + b.diameter()))
            << a.name() << ", " << b.name() << " along " << u.transpose();
      }
    }
  }
}

TEST(Penetration, OfFacesNearlyParallelIsTheSameFromEitherSide) {
  RandomStream random{19};
  for (const SolidKind kind :
       {SolidKind::cube, SolidKind::octahedron, SolidKind::dodecahedron, SolidKind::icosahedron}) {
    const ConvexSolid& solid = platonic(kind);
    for (int k = 0; k < 8; ++k) {
      const auto face = static_cast<int>(random.uniform() * static_cast<double>(solid.faces().size()));
      const Face& own = solid.faces()[static_cast<std::size_t>(face)];
      const auto corner = [&](std::size_t c) { return solid.arrays().vertex(own.vertices[c]); };
      // The opposite face is placed on this face, rotated about the normal. The centres are shifted. The two faces are
      // parallel within the rounding of the orientation.
      Pose a, b;
      b.orientation = Eigen::AngleAxisd(6 * random.uniform(), own.normal);
      const Quad3 r = (2 * solid.arrays().plane_offset(face) - Quad(2e-15)) * solid.arrays().normal(face) +
                      Quad(.3) * (corner(1) - corner(0));
      const Quad there = penetration(solid, solid, relative_pose(a, b, r)).depth;
      const Quad back = penetration(solid, solid, relative_pose(b, a, Quad(-1) * r)).depth;
      EXPECT_NEAR(static_cast<double>(there), 2e-15, 1e-15) << solid.name() << " " << k;
      EXPECT_NEAR(static_cast<double>(there - back), 0, 1e-12 * static_cast<double>(there))
          << solid.name() << " " << k << ": " << static_cast<double>(there) << " and " << static_cast<double>(back);
    }
  }
}

}  // namespace
}  // namespace isojam
