#include "engine/geometry/overlap/separating_axis.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <map>

#include "engine/geometry/overlap/clipped_overlap.hpp"
#include "tests/engine/geometry/overlap/pairs.hpp"

namespace isojam {
namespace {

using namespace testing_pairs;
using Eigen::Vector3d;
using Kind = SeparatingAxis::Kind;

constexpr int cases = 24;  // for each pair of solids

/// A pair at a random distance, from overlap to clear separation.
Pair near_pair(RandomStream& random, SolidKind a, SolidKind b) {
  const double nearest = platonic(a).inradius() + platonic(b).inradius();
  const double farthest = platonic(a).circumradius() + platonic(b).circumradius();
  return random_pair(random, a, b, nearest + (farthest - nearest) * random.uniform());
}

template <class Check>
void for_each_near_pair(std::uint64_t seed, const Check& check) {
  RandomStream random{2, seed};
  for (const SolidKind a : all_solids) {
    for (const SolidKind b : all_solids) {
      for (int k = 0; k < cases; ++k) check(near_pair(random, a, b));
    }
  }
}

double best_gap(const Pair& pair) {
  const RelativePose pose = pair.relative();
  return gap(pair.solid_a(), pair.solid_b(), pose, best_axis(pair.solid_a(), pair.solid_b(), pose));
}

/// Unit vector of an axis in A's frame, pointing from A to B.
Vector3d direction(const Pair& pair, const SeparatingAxis& axis) {
  const RelativePose pose = pair.relative();
  const auto along = [](const ConvexSolid& solid, int edge) -> Vector3d {
    return solid.vertices()[solid.edges()[edge].head] - solid.vertices()[solid.edges()[edge].tail];
  };
  if (axis.kind == Kind::face_a) return pair.solid_a().faces()[axis.a].normal;
  if (axis.kind == Kind::face_b) return -(pose.rotation * pair.solid_b().faces()[axis.b].normal);
  const Vector3d u = along(pair.solid_a(), axis.a).cross(pose.rotation * along(pair.solid_b(), axis.b)).normalized();
  return u.dot(pose.displacement) < 0 ? -u : u;
}

double projected_gap(const Pair& pair, const Vector3d& u) {
  const RelativePose pose = pair.relative();
  double top_a = -std::numeric_limits<double>::infinity(), bottom_b = std::numeric_limits<double>::infinity();
  for (const Vector3d& v : pair.solid_a().vertices()) top_a = std::max(top_a, u.dot(v));
  for (const Vector3d& v : pair.solid_b().vertices())
    bottom_b = std::min(bottom_b, u.dot(pose.rotation * v + pose.displacement));
  return bottom_b - top_a;
}

TEST(SeparatingAxisTest, AGapMeansNoOverlap) {
  int apart = 0;
  for_each_near_pair(1, [&](const Pair& pair) {
    const RelativePose pose = pair.relative();
    const ConvexSolid &a = pair.solid_a(), &b = pair.solid_b();
    if (best_gap(pair) <= gap_tolerance(a, b, pose)) return;
    ++apart;
    const Overlap fast = overlap(pair), slow = clipped_overlap(a, b, pose);
    EXPECT_FALSE(fast.touching() || slow.touching())
        << "gap " << best_gap(pair) << ", V " << fast.volume << ", clipped " << slow.volume << "\n"
        << describe(pair);
    EXPECT_EQ(fast.path, OverlapPath::separated);
    EXPECT_EQ(fast.area.norm() + fast.moment.norm(), 0);
    EXPECT_TRUE((fast.faces_a | fast.faces_b | fast.edges_a | fast.edges_b).empty());
  });
  EXPECT_GT(apart, cases * 5) << "too few separated pairs to prove anything";
}

TEST(SeparatingAxisTest, NoGapMeansOverlap) {
  int together = 0;
  for_each_near_pair(2, [&](const Pair& pair) {
    if (best_gap(pair) >= -gap_tolerance(pair.solid_a(), pair.solid_b(), pair.relative())) return;
    ++together;
    EXPECT_TRUE(overlap(pair).touching()) << "gap " << best_gap(pair) << "\n" << describe(pair);
  });
  EXPECT_GT(together, cases * 5) << "too few overlapping pairs to prove anything";
}

TEST(SeparatingAxisTest, TheGapIsThatOfTheProjections) {
  for_each_near_pair(3, [&](const Pair& pair) {
    const RelativePose pose = pair.relative();
    const SeparatingAxis axis = best_axis(pair.solid_a(), pair.solid_b(), pose);
    EXPECT_NEAR(gap(pair.solid_a(), pair.solid_b(), pose, axis), projected_gap(pair, direction(pair, axis)),
                16 * epsilon * pair.reach())
        << describe(pair);
  });
}

TEST(SeparatingAxisTest, BestIsTheLargestWhicheverSolidIsFirst) {
  for_each_near_pair(4, [&](const Pair& pair) {
    const RelativePose pose = pair.relative();
    const double best = best_gap(pair), tolerance = 32 * epsilon * pair.reach();
    EXPECT_NEAR(best, best_gap(exchanged(pair)), tolerance) << describe(pair);
    for (std::size_t f = 0; f < pair.solid_a().faces().size(); ++f)
      EXPECT_LE(projected_gap(pair, pair.solid_a().faces()[f].normal), best + tolerance) << "face " << f;
    for (std::size_t f = 0; f < pair.solid_b().faces().size(); ++f)
      EXPECT_LE(projected_gap(pair, -(pose.rotation * pair.solid_b().faces()[f].normal)), best + tolerance)
          << "face " << f << " of B";
  });
}

TEST(SeparatingAxisTest, AllKindsSeparate) {
  std::map<Kind, int> seen;
  for_each_near_pair(5, [&](const Pair& pair) {
    const RelativePose pose = pair.relative();
    const SeparatingAxis axis = best_axis(pair.solid_a(), pair.solid_b(), pose);
    if (gap(pair.solid_a(), pair.solid_b(), pose, axis) > 0) ++seen[axis.kind];
  });
  for (const Kind kind : {Kind::face_a, Kind::face_b, Kind::edge_edge})
    EXPECT_GT(seen[kind], cases) << "kind " << static_cast<int>(kind);
  EXPECT_EQ(seen.count(Kind::none), 0U);
}

TEST(SeparatingAxisTest, OverlapReturnsASeparatingFace) {
  int handed = 0;
  for_each_near_pair(6, [&](const Pair& pair) {
    const RelativePose pose = pair.relative();
    SeparatingAxis axis;
    const Overlap result = relative_overlap(pair.solid_a(), pair.solid_b(), pose, axis);
    if (axis.kind == Kind::none) return;
    ++handed;
    EXPECT_FALSE(result.touching()) << describe(pair);
    EXPECT_GT(gap(pair.solid_a(), pair.solid_b(), pose, axis), -gap_tolerance(pair.solid_a(), pair.solid_b(), pose))
        << describe(pair);
  });
  EXPECT_GT(handed, cases * 5);
}

TEST(SeparatingAxisTest, NoAxisHasNoGap) {
  const ConvexSolid& cube = platonic(SolidKind::cube);
  EXPECT_EQ(gap(cube, cube, RelativePose{}, SeparatingAxis{}), -std::numeric_limits<double>::infinity());
}

}  // namespace
}  // namespace isojam
