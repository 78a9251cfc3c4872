// Reference: clipping in quadruple precision.

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "engine/geometry/solids/solid.hpp"
#include "tests/engine/geometry/overlap/pair_truth.hpp"

namespace isojam {
namespace {

using namespace testing_pairs;
using Eigen::Vector3d;

/// Boxes, prisms, the built-in solids, ten points on a sphere, and a pyramid with as many vertices as a cube but more
/// edges.
const std::vector<Solid>& others() {
  static const std::vector<Solid> solids = [] {
    std::vector<Vector3d> brick, pyramid{{0, 0, 1}};
    for (int k = 0; k < 8; ++k) brick.emplace_back(k & 1 ? 1 : 0, k & 2 ? 1.5 : 0, k & 4 ? 2 : 0);
    for (int k = 0; k < 7; ++k) pyramid.emplace_back(std::cos(6.28 * k / 7), std::sin(6.28 * k / 7), 0);
    return std::vector<Solid>{*Solid::named("truncated_tetrahedron"),
                              *Solid::named("cuboctahedron"),
                              *Solid::named("rhombic_dodecahedron"),
                              *Solid::named("prism3"),
                              *Solid::named("prism6"),
                              *Solid::named("antiprism5"),
                              *Solid::named("antiprism8"),
                              Solid::made_of("brick", brick),
                              Solid::made_of("pyramid", pyramid),
                              Solid::made_of("rock", points_on_sphere(10, 71)),
                              *Solid::named("cube")};
  }();
  return solids;
}

template <class Visit>
void for_each_pair(const Visit& visit) {
  for (std::size_t i = 0; i < others().size(); ++i) {
    for (std::size_t j = i; j < others().size(); ++j) visit(*others()[i], *others()[j]);
  }
}

TEST(OtherSolids, FaceContactsAreAccurate) {
  RandomStream random{72};
  expect_flat_contacts_right([](const auto& visit) { for_each_pair(visit); }, random);
}

TEST(OtherSolids, CornersAndCrossedEdgesAreAccurate) {
  RandomStream random{73};
  PointedContacts contacts;
  for_each_pair([&](const ConvexSolid& a, const ConvexSolid& b) {
    for (const double volume : {1e-3, 1e-6, 1e-9, 1e-12, 1e-15})
      contacts.expect_right(random_approach(a, b, random), volume);
  });
  contacts.expect_more_than(150);
}

TEST(OtherSolids, HessiansAgreeWithDifferences) {
  RandomStream random{74};
  expect_hessians_of_differences([](const auto& visit) { for_each_pair(visit); }, random, 40);
}

TEST(OtherSolids, CoincidentSolidsAreAccurate) {
  expect_coincident_right([](const auto& visit) {
    for (const Solid& solid : others()) visit(*solid);
  });
}

}  // namespace
}  // namespace isojam
