// Wide solids have 33 to 64 edges. Reference: clipping in quadruple precision.

#include <gtest/gtest.h>

#include <algorithm>
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

}  // namespace
}  // namespace isojam
