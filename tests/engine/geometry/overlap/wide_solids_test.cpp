// Wide solids have 33 to 64 edges. Reference: clipping in quadruple precision.

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
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

/// The built-in wide solids, and the solids with the most faces, vertices and edges that a wide solid can have.
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
  PointedContacts contacts{.with_features = true};
  int beyond = 0;
  for_each_pair([&](const ConvexSolid& a, const ConvexSolid& b) {
    for (const double volume : {1e-3, 1e-6, 1e-9, 1e-12, 1e-15}) {
      for (const auto& approach : {random_approach, corner_over_face, edge_over_edge}) {
        const auto got = contacts.expect_right(approach(a, b, random), volume);
        beyond += got && (got->edges_a | got->edges_b).word[0] >> 32 != 0;
      }
    }
  });
  contacts.expect_more_than(500);
  EXPECT_GT(beyond, 100);
  EXPECT_LT(contacts.clipped, contacts.pairs / 50);
}

TEST(WideSolids, HessiansAgreeWithDifferences) {
  RandomStream random{85};
  expect_hessians_of_differences([](const auto& visit) { for_each_pair(visit); }, random, 30);
}

TEST(WideSolids, CoincidentSolidsAreAccurate) {
  expect_coincident_right([](const auto& visit) {
    for (const ConvexSolid* solid : wide_solids()) visit(*solid);
  });
}

/// Members of a loop that must not depend on the limit of edges, except for the numbers of the edges of B.
template <class Narrow, class Wide>
void expect_same(const Narrow& narrow, const Wide& wide, const std::string& what) {
  ASSERT_EQ(narrow.verdict, wide.verdict) << what;
  if (narrow.verdict != LoopVerdict::closed) return;
  ASSERT_EQ(narrow.spans, wide.spans) << what;
  ASSERT_EQ(narrow.segments, wide.segments) << what;
  EXPECT_EQ(narrow.up, wide.up) << what;
  for (int k = 0; k < narrow.spans; ++k) {
    const auto& n = narrow.crossing[k];
    const auto& w = wide.crossing[k];
    EXPECT_EQ(n.edge / narrow.edge_of_b, w.edge / wide.edge_of_b) << what;
    EXPECT_EQ(n.edge % narrow.edge_of_b, w.edge % wide.edge_of_b) << what;
    EXPECT_TRUE(n.into == w.into && n.out_of == w.out_of) << what;
    EXPECT_TRUE(n.enters() == w.enters() && n.leaves() == w.leaves()) << what;
    const auto same_face = [](std::uint32_t of_narrow, std::uint32_t of_wide) {
      return of_narrow / Narrow::face_of_b == of_wide / Wide::face_of_b &&
             of_narrow % Narrow::face_of_b == of_wide % Wide::face_of_b;
    };
    EXPECT_TRUE(same_face(narrow.span[k].left, wide.span[k].left)) << what;
    EXPECT_TRUE(same_face(narrow.span[k].right, wide.span[k].right)) << what;
    for (const int corner : {2 * k, 2 * k + 1})
      EXPECT_TRUE(std::equal(narrow.corner[corner], narrow.corner[corner] + 4, wide.corner[corner])) << what;
  }
  for (int k = 0; k < narrow.segments; ++k) {
    const auto& n = narrow.segment[k];
    const auto& w = wide.segment[k];
    EXPECT_TRUE(n.face_a == w.face_a && n.face_b == w.face_b && n.from == w.from && n.to == w.to) << what;
    EXPECT_EQ(narrow.hub[n.face_a], wide.hub[n.face_a]) << what;
    EXPECT_EQ(narrow.hub[Narrow::face_of_b + n.face_b], wide.hub[Wide::face_of_b + n.face_b]) << what;
  }
  for (int s = 0; s < 2; ++s) {
    EXPECT_EQ(FeatureSet(narrow.faces[s]), FeatureSet(wide.faces[s])) << what;
    EXPECT_EQ(FeatureSet(narrow.edges[s]), FeatureSet(wide.edges[s])) << what;
  }
}

/// Compares the loops of named solids with `least` to `most` edges for two limits of edges.
template <int limit, int other>
void compare_loops(int least, int most, std::uint64_t seed) {
  RandomStream random{seed};
  int closed = 0;
  for (const std::string_view name_a : named_solids()) {
    for (const std::string_view name_b : named_solids()) {
      const ConvexSolid &a = **Solid::named(name_a), &b = **Solid::named(name_b);
      const int edges = std::max(a.arrays().edges, b.arrays().edges);
      if (edges < least || edges > most) continue;
      for (int k = 0; k < 40; ++k) {
        const LonePlacedSolid at_a(a, rotation_matrix({{}, random_orientation(random)}));
        const LonePlacedSolid at_b(b, rotation_matrix({{}, random_orientation(random)}));
        const DoubleDoubleVector r{(a.circumradius() + b.inradius()) * random_direction(random)};
        LoopWith<limit> narrow;
        LoopWith<other> wide;
        find_contact_loop<limit>(at_a, at_b, r.high, narrow);
        find_contact_loop<other>(at_a, at_b, r.high, wide);
        closed += narrow.verdict == LoopVerdict::closed;
        expect_same(narrow, wide, names(a, b) + " in doubles");
        find_contact_loop<limit>(at_a, at_b, r, narrow);
        find_contact_loop<other>(at_a, at_b, r, wide);
        expect_same(narrow, wide, names(a, b) + " in double-double");
      }
    }
  }
  std::printf("%d loops closed\n", closed);
  EXPECT_GT(closed, 800);
}

TEST(WideLoop, GivesTheSameForNarrowSolids) { compare_loops<narrow_edges, wide_edges>(0, narrow_edges, 86); }

TEST(LargeLoop, GivesTheSameForNarrowSolids) { compare_loops<narrow_edges, large_edges>(0, narrow_edges, 87); }

TEST(LargeLoop, GivesTheSameForWideSolids) { compare_loops<wide_edges, large_edges>(narrow_edges + 1, wide_edges, 88); }

}  // namespace
}  // namespace isojam
