// Reference: clipping.

#include <gtest/gtest.h>

#include <cmath>
#include <sstream>

#include "engine/geometry/overlap/clipped_overlap.hpp"
#include "engine/geometry/overlap/overlap.hpp"
#include "engine/geometry/overlap/separating_axis.hpp"
#include "tests/engine/geometry/overlap/pairs.hpp"

namespace isojam {
namespace {

using namespace testing_pairs;
using Eigen::Vector3d;

constexpr int cases = 30;

/// Description of the differences between `result` and `reference`; empty if there are none.
std::string disagreement(const Pair& pair, const Overlap& result, const Overlap& reference) {
  // The error of a coordinate is a few ulp of the reach (the size of the pair). It is compared with the depth V/|S|.
  const double scale = reference.area.norm();
  const double limit = 64 * epsilon * pair.reach() * scale / reference.volume;
  const double volume = std::abs(result.volume - reference.volume) / reference.volume;
  const double area = (result.area - reference.area).norm() / scale;
  const double moment = (result.moment - reference.moment).norm() / (scale * pair.reach());
  std::ostringstream text;
  if (!(volume <= limit && area <= limit && moment <= limit))
    text << "V off by " << volume << ", S " << area << ", M " << moment << " where " << limit << " is allowed\n";
  if (result.faces_a != reference.faces_a || result.faces_b != reference.faces_b)
    text << "faces " << result.faces_a.word[0] << " " << result.faces_b.word[0] << " instead of "
         << reference.faces_a.word[0] << " " << reference.faces_b.word[0] << "\n";
  if (result.edges_a != reference.edges_a || result.edges_b != reference.edges_b)
    text << "edges " << result.edges_a.word[0] << " " << result.edges_b.word[0] << " instead of "
         << reference.edges_a.word[0] << " " << reference.edges_b.word[0] << "\n";
  if (!text.str().empty()) text << describe(pair);
  return text.str();
}

TEST(OverlapPathsTest, LoopAgreesWithClipping) {
  RandomStream random{4, 1};
  int by_loop = 0, all = 0;
  for (const SolidKind a : all_solids) {
    for (const SolidKind b : all_solids) {
      for (int k = 0; k < cases; ++k, ++all) {
        const Pair pair = random_contact(random, a, b, 1e-6, .5);
        const Overlap fast = overlap(pair);
        by_loop += fast.path == OverlapPath::loop;
        const Overlap slow = clipped_overlap(pair.solid_a(), pair.solid_b(), pair.relative());
        EXPECT_EQ(disagreement(pair, fast, slow), "");
      }
    }
  }
  EXPECT_EQ(by_loop, all) << "random pairs are not degenerate";
}

TEST(OverlapPathsTest, ASlightlyWrongVolumeIsRejected) {
  RandomStream random{4, 2};
  for (int k = 0; k < cases; ++k) {
    const Pair pair = random_contact(random, SolidKind::tetrahedron, SolidKind::icosahedron, 1e-3, .1);
    Overlap wrong = overlap(pair);
    const Overlap slow = clipped_overlap(pair.solid_a(), pair.solid_b(), pair.relative());
    EXPECT_EQ(disagreement(pair, wrong, slow), "");
    wrong.volume *= 1 + 1e-9;
    EXPECT_NE(disagreement(pair, wrong, slow), "") << describe(pair);
  }
}

TEST(OverlapPathsTest, CoincidentSolidsAreClipped) {
  RandomStream random{4, 3};
  for (const SolidKind kind : all_solids) {
    Pair pair{kind, kind, {}, {}};
    for (int k = 0; k < cases; ++k) {
      pair.a.orientation = pair.b.orientation = k == 0 ? Eigen::Quaterniond::Identity() : random_orientation(random);
      const Overlap result = overlap(pair);
      EXPECT_EQ(result.path, OverlapPath::clip) << describe(pair);
      // The rotation matrix is orthonormal within a few ulp. The solids have unit volume and a surface of 5 to 7.
      EXPECT_NEAR(result.volume, 1, 64 * epsilon) << describe(pair);
    }
  }
}

TEST(OverlapPathsTest, EqualOrientationWithCommonFacePlanesIsClipped) {
  RandomStream random{4, 4};
  for (const SolidKind kind : all_solids) {
    const ConvexSolid& solid = platonic(kind);
    for (int k = 0; k < cases; ++k) {
      const Face& face = solid.faces()[static_cast<std::size_t>(k) % solid.faces().size()];
      const Vector3d along = face.normal.cross(random_direction(random)).normalized();
      Pair pair{kind, kind, {}, {}};
      pair.b.position = .4 * solid.inradius() * random.uniform() * along;
      EXPECT_EQ(overlap(pair).path, OverlapPath::clip) << "face " << k << ": " << describe(pair);
    }
  }
}

TEST(OverlapPathsTest, CubesOfEqualOrientationShareABox) {
  RandomStream random{4, 5};
  for (int k = 0; k < 10 * cases; ++k) {
    Pair pair{SolidKind::cube, SolidKind::cube, {}, {}};
    double box = 1;
    for (int c = 0; c < 3; ++c) {
      // If some coordinates are zero, faces of the cubes are coplanar.
      pair.b.position[c] = random.uniform() < .3 ? 0 : 2 * random.uniform() - 1;
      box *= 1 - std::abs(pair.b.position[c]);
    }
    EXPECT_NEAR(overlap(pair).volume, box, 64 * epsilon) << describe(pair);
  }
}

}  // namespace
}  // namespace isojam
