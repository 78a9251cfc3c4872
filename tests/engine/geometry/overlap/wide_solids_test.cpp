// Properties tested here for wide solids, which have 33 to 64 edges. The pairs are each with itself, with each other,
// and with an octahedron and a cube as A or B. overlap() in double-double is compared with clipping in quadruple
// precision:
// - For face-face contacts with depths of 1e-4 … 1e-12 and tilts as large, V, S and M have errors of at most 1e-13,
//   half of the pairs at most 1e-15. The contact loop computes them.
// - For corners in faces, crossed edges and random orientations with V = 1e-3 … 1e-15, errors are at most 1e-12.
// - The Hessian agrees with differences of S in quadruple precision to 1e-8 of its translational block.
// - For solids that coincide and for coplanar faces, errors are at most 1e-14, with the loop or with clipping.
// - The reported features are those that clipping finds. Some of them have numbers above 31.
// For solids with at most 32 edges, the contact loop for 64 edges gives exactly the same results as the one for 32
// edges.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <span>
#include <string>
#include <vector>

#include "engine/geometry/overlap/contact_loop.hpp"
#include "engine/geometry/solids/named_solids.hpp"
#include "engine/geometry/solids/solid.hpp"
#include "tests/engine/geometry/overlap/pair_truth.hpp"
#include "tests/engine/geometry/overlap/pairs.hpp"

namespace isojam {
namespace {

using namespace testing_pairs;

/// The dual solid: its vertices are the planes of the other solid. The dual of a solid with many faces has many
/// vertices.
ConvexSolid dual(const std::string& name, const ConvexSolid& solid) {
  std::vector<Quad3> points;
  for (int f = 0; f < solid.arrays().faces; ++f)
    points.push_back((1 / solid.arrays().plane_offset(f)) * solid.arrays().normal(f));
  return ConvexSolid(name, points);
}

/// The built-in wide solids, and the solids with the most faces, vertices and edges that are allowed (64 each).
const std::vector<const ConvexSolid*>& wide_solids() {
  static const ConvexSolid stone("stone of 22", points_on_sphere(22, 81));
  static const ConvexSolid most_faces("stone of 23", points_on_sphere(23, 82));
  static const ConvexSolid most_vertices = dual("dual of the stone of 23", most_faces);
  static const std::vector<const ConvexSolid*> solids{&*(*Solid::named("truncated_octahedron")),
                                                      &*(*Solid::named("truncated_cube")),
                                                      &*(*Solid::named("prism20")),
                                                      &*(*Solid::named("antiprism16")),
                                                      &stone,
                                                      &most_faces,
                                                      &most_vertices};
  return solids;
}

template <class Visit>
void for_each_pair(const Visit& visit) {
  const auto& wide = wide_solids();
  for (std::size_t i = 0; i < wide.size(); ++i) {
    for (std::size_t j = i; j < wide.size(); ++j) visit(*wide[i], *wide[j]);
    visit(*wide[i], platonic(SolidKind::octahedron));
    visit(platonic(SolidKind::cube), *wide[i]);
  }
}

TEST(WideSolids, AreWide) {
  int most_vertices = 0, most_faces = 0, most_edges = 0;
  for (const ConvexSolid* solid : wide_solids()) {
    EXPECT_GT(solid->arrays().edges, narrow_edges) << solid->name();
    most_vertices = std::max(most_vertices, solid->arrays().vertices);
    most_faces = std::max(most_faces, solid->arrays().faces);
    most_edges = std::max(most_edges, solid->arrays().edges);
  }
  EXPECT_EQ(most_vertices, 42);
  EXPECT_EQ(most_faces, 42);
  EXPECT_EQ(most_edges, 64);
}

TEST(WideSolids, FaceContactsAreAccurate) {
  RandomStream random{83};
  expect_flat_contacts_right([](const auto& visit) { for_each_pair(visit); }, random);
}

TEST(WideSolids, CornersAndCrossedEdgesAreAccurate) {
  RandomStream random{84};
  double worst = 0;
  int pairs = 0, skipped = 0, clipped = 0, beyond = 0;
  for_each_pair([&](const ConvexSolid& a, const ConvexSolid& b) {
    for (const double volume : {1e-3, 1e-6, 1e-9, 1e-12, 1e-15}) {
      for (const auto& approach : {random_approach, corner_over_face, edge_over_edge}) {
        const auto touching = at_volume(approach(a, b, random), volume);
        if (!touching) ++skipped;
        if (!touching) continue;
        ++pairs;
        const double here = error(*touching);
        EXPECT_LE(here, 1e-12) << names(a, b) << ", V " << volume;
        worst = std::max(worst, here);
        const Overlap got = found(*touching);
        const QuadOverlap right = exact(*touching);
        clipped += got.path == OverlapPath::clip;
        beyond += std::max(got.edges_a, got.edges_b) >> 32 != 0;
        EXPECT_EQ(got.faces_a, right.faces_a) << names(a, b) << ", V " << volume;
        EXPECT_EQ(got.faces_b, right.faces_b) << names(a, b) << ", V " << volume;
        EXPECT_EQ(got.edges_a, right.edges_a) << names(a, b) << ", V " << volume;
        EXPECT_EQ(got.edges_b, right.edges_b) << names(a, b) << ", V " << volume;
      }
    }
  });
  std::printf("%d pointed contacts: %.1e at worst, %d clipped, %d not made, %d with edges beyond 31\n", pairs, worst,
              clipped, skipped, beyond);
  EXPECT_GT(pairs, 500);
  EXPECT_GT(beyond, 100);
  EXPECT_LT(clipped, pairs / 50);
}

TEST(WideSolids, HessiansAgreeWithDifferences) {
  RandomStream random{85};
  expect_hessians_of_differences([](const auto& visit) { for_each_pair(visit); }, random, 30);
}

TEST(WideSolids, CoincidentSolidsAreAccurate) {
  double worst = 0;
  for (const ConvexSolid* solid : wide_solids()) {
    PosedPair same{*solid, *solid, {}, {}};
    EXPECT_NEAR(found(same).volume, 1, 1e-14) << solid->name();
    // If a solid is shifted along an edge, faces remain in the same plane.
    const Edge& edge = solid->edges().front();
    same.at_b.position = .3 * (solid->vertices()[edge.head] - solid->vertices()[edge.tail]);
    const double here = error(same);
    EXPECT_LE(here, 1e-14) << solid->name();
    worst = std::max(worst, here);
  }
  std::printf("faces in each other: %.1e at worst\n", worst);
}

/// Members of a loop that must not depend on the size of its arrays, except for the numbers of the edges.
void expect_same(const ContactLoop& narrow, const ContactLoop& wide, const std::string& what) {
  ASSERT_EQ(narrow.verdict, wide.verdict) << what;
  if (narrow.verdict != LoopVerdict::closed) return;
  ASSERT_EQ(narrow.spans, wide.spans) << what;
  ASSERT_EQ(narrow.segments, wide.segments) << what;
  EXPECT_EQ(narrow.up, wide.up) << what;
  for (int k = 0; k < narrow.spans; ++k) {
    const auto &n = narrow.crossing[k], &w = wide.crossing[k];
    EXPECT_EQ(n.edge / narrow.edge_of_b, w.edge / wide.edge_of_b) << what;
    EXPECT_EQ(n.edge % narrow.edge_of_b, w.edge % wide.edge_of_b) << what;
    EXPECT_TRUE(n.into == w.into && n.out_of == w.out_of && n.ends == w.ends) << what;
    EXPECT_TRUE(narrow.span[k].left == wide.span[k].left && narrow.span[k].right == wide.span[k].right) << what;
    for (const int corner : {2 * k, 2 * k + 1})
      EXPECT_TRUE(std::equal(narrow.corner[corner], narrow.corner[corner] + 4, wide.corner[corner])) << what;
  }
  for (int k = 0; k < narrow.segments; ++k) {
    const auto &n = narrow.segment[k], &w = wide.segment[k];
    EXPECT_TRUE(n.face_a == w.face_a && n.face_b == w.face_b && n.from == w.from && n.to == w.to) << what;
    EXPECT_EQ(narrow.hub[n.face_a], wide.hub[n.face_a]) << what;
    EXPECT_EQ(narrow.hub[ContactLoop::face_of_b + n.face_b], wide.hub[ContactLoop::face_of_b + n.face_b]) << what;
  }
  for (int s = 0; s < 2; ++s) {
    EXPECT_EQ(narrow.faces[s], wide.faces[s]) << what;
    EXPECT_EQ(narrow.edges[s], wide.edges[s]) << what;
  }
}

TEST(WideLoop, GivesTheSameForNarrowSolids) {
  RandomStream random{86};
  int closed = 0;
  for (const std::string_view name_a : named_solids()) {
    for (const std::string_view name_b : named_solids()) {
      const ConvexSolid &a = **Solid::named(name_a), &b = **Solid::named(name_b);
      if (std::max(a.arrays().edges, b.arrays().edges) > narrow_edges) continue;
      for (int k = 0; k < 40; ++k) {
        const LonePlacedSolid at_a(a, rotation_matrix({{}, random_orientation(random)}));
        const LonePlacedSolid at_b(b, rotation_matrix({{}, random_orientation(random)}));
        const DoubleDoubleVector r{(a.circumradius() + b.inradius()) * random_direction(random)};
        ContactLoop narrow, wide;
        find_contact_loop<narrow_edges>(at_a, at_b, r.high, narrow);
        find_contact_loop<wide_edges>(at_a, at_b, r.high, wide);
        closed += narrow.verdict == LoopVerdict::closed;
        expect_same(narrow, wide, names(a, b) + " in doubles");
        find_contact_loop<narrow_edges>(at_a, at_b, r, narrow);
        find_contact_loop<wide_edges>(at_a, at_b, r, wide);
        expect_same(narrow, wide, names(a, b) + " in double-double");
      }
    }
  }
  std::printf("%d loops closed\n", closed);
  EXPECT_GT(closed, 1000);
}

}  // namespace
}  // namespace isojam
