#include "engine/geometry/overlap/distances.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "engine/geometry/overlap/clipped_overlap.hpp"
#include "tests/engine/geometry/overlap/pairs.hpp"

namespace isojam {
namespace {

using namespace testing_pairs;
using Eigen::Vector3d;

struct Placed {
  LonePlacedSolid a, b;
  Vector3d r;

  explicit Placed(const Pair& pair)
      : a(pair.solid_a(), rotation_matrix(pair.a)),
        b(pair.solid_b(), rotation_matrix(pair.b)),
        r(pair.displacement()) {}
};

/// In half of the pairs, the contact has a volume between 1e-6 and 0.1. In the others, the circumspheres overlap or
/// almost overlap.
template <class Check>
void for_many_pairs(int cases, const Check& check) {
  RandomStream random{19, 3};
  for (const SolidKind a : all_solids) {
    for (const SolidKind b : all_solids) {
      const double radii = platonic(a).circumradius() + platonic(b).circumradius();
      for (int k = 0; k < cases; ++k) {
        const double greatest = std::pow(10, -1 - k / 2 % 5);
        check(k % 2 ? random_pair(random, a, b, radii * (.5 + .6 * random.uniform()))
                    : random_contact(random, a, b, greatest / 10, greatest));
      }
    }
  }
}

TEST(Slab, KeepsWhatBoundsTheIntersection) {
  int touching = 0, empty = 0, left_out = 0;
  for_many_pairs(40, [&](const Pair& pair) {
    const Placed placed(pair);
    const auto slab = slab_between<SmallSolids>(placed.a, placed.b, placed.r);
    const Overlap clipped = clipped_overlap(pair.solid_a(), pair.solid_b(), pair.relative());
    touching += clipped.touching();
    empty += slab.of_a.faces.empty();
    left_out += pair.solid_a().arrays().faces - slab.of_a.faces.count();
    EXPECT_EQ(slab.of_a.faces.empty(), slab.of_b.faces.empty()) << describe(pair);
    EXPECT_EQ(clipped.faces_a & ~FeatureSet(slab.of_a.faces), 0U) << describe(pair);
    EXPECT_EQ(clipped.faces_b & ~FeatureSet(slab.of_b.faces), 0U) << describe(pair);
    EXPECT_EQ(clipped.edges_a & ~FeatureSet(slab.of_a.edges), 0U) << describe(pair);
    EXPECT_EQ(clipped.edges_b & ~FeatureSet(slab.of_b.edges), 0U) << describe(pair);
  });
  EXPECT_GT(touching, 400);
  EXPECT_GT(empty, 40);
  EXPECT_GT(left_out, 1000) << "nothing would be saved";
}

/// Vertices of a solid at `centre` whose coordinate along u is above `bound`. If `sign` is −1, those below it.
std::uint64_t beyond(const PlacedSolid& solid, const Vector3d& centre, const Vector3d& u, double sign, double bound) {
  std::uint64_t found = 0;
  for (int v = 0; v < solid.vertices(); ++v)
    found |= std::uint64_t{sign * u.dot(centre + solid.vertex(v)) >= sign * bound} << v;
  return found;
}

/// The faces and edges that contain one of the vertices.
Parts<1> parts_with(const ConvexSolid& solid, std::uint64_t vertices) {
  Parts<1> parts;
  const auto has = [&](int v) { return (vertices >> v & 1) != 0; };
  for (std::size_t e = 0; e < solid.edges().size(); ++e) {
    const Edge& edge = solid.edges()[e];
    if (!has(edge.tail) && !has(edge.head)) continue;
    parts.edges |= std::uint64_t{1} << e;
    parts.vertices |= std::uint64_t{1} << edge.tail | std::uint64_t{1} << edge.head;
  }
  for (std::size_t f = 0; f < solid.faces().size(); ++f) {
    const auto& corners = solid.faces()[f].vertices;
    if (std::any_of(corners.begin(), corners.end(), has)) parts.faces |= std::uint64_t{1} << f;
  }
  return parts;
}

void expect_equal(const Parts<1>& found, const Parts<1>& expected, const Pair& pair) {
  EXPECT_EQ(found.vertices, expected.vertices) << describe(pair);
  EXPECT_EQ(found.edges, expected.edges) << describe(pair);
  EXPECT_EQ(found.faces, expected.faces) << describe(pair);
}

TEST(Slab, IsBetweenTheSupports) {
  for_many_pairs(20, [](const Pair& pair) {
    const Placed placed(pair);
    const PlacedSolid a = placed.a, b = placed.b;
    const Vector3d u = placed.r.normalized();
    double top = -pair.reach(), bottom = 2 * pair.reach();
    for (int v = 0; v < a.vertices(); ++v) top = std::max(top, u.dot(a.vertex(v)));
    for (int v = 0; v < b.vertices(); ++v) bottom = std::min(bottom, u.dot(placed.r + b.vertex(v)));
    const auto slab = slab_between<SmallSolids>(a, b, placed.r);
    const double slack = 1e-8 * pair.reach();
    if (std::abs(top - bottom) < 2 * slack) return;
    if (top < bottom) {
      EXPECT_EQ(slab.of_a.faces, 0U) << describe(pair);
      return;
    }
    if (beyond(a, Vector3d::Zero(), u, 1, bottom - slack) != beyond(a, Vector3d::Zero(), u, 1, bottom + slack) ||
        beyond(b, placed.r, u, -1, top + slack) != beyond(b, placed.r, u, -1, top - slack))
      return;
    expect_equal(slab.of_a, parts_with(pair.solid_a(), beyond(a, Vector3d::Zero(), u, 1, bottom)), pair);
    expect_equal(slab.of_b, parts_with(pair.solid_b(), beyond(b, placed.r, u, -1, top)), pair);
  });
}

TEST(NearDistances, AreThoseOfTheWholeTable) {
  for_many_pairs(10, [](const Pair& pair) {
    const Placed placed(pair);
    const PlacedSolid a = placed.a, b = placed.b;
    const auto slab = slab_between<SmallSolids>(a, b, placed.r);
    if (slab.of_a.faces.empty()) return;
    alignas(32) double near_table[Distances<SmallSolids>::max_size];
    Distances<SmallSolids> near;
    near.of = near_table;
    tabulate_near_distances(a, b, placed.r, slab, near);
    EXPECT_EQ(near.rows, slab.of_a.vertices);
    EXPECT_EQ(near.candidates, slab.of_a.edges);
    std::uint64_t faces = 0;
    for (int k = 0; k < near.planes; ++k) faces |= std::uint64_t{1} << near.face[k];
    EXPECT_EQ(faces, slab.of_b.faces) << describe(pair);
    near.rows.for_each([&](int v) {
      for (int k = 0; k < near.planes; ++k) {
        const double distance = b.normal(near.face[k]).dot(a.vertex(v) - placed.r) - b.offset()[near.face[k]];
        EXPECT_NEAR(near.row(v)[k], distance, 16 * epsilon * pair.reach()) << describe(pair);
      }
    });
  });
}

}  // namespace
}  // namespace isojam
