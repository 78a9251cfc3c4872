// Reference: clipping in quadruple precision.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <vector>

#include "engine/geometry/solids/solid.hpp"
#include "tests/engine/geometry/overlap/pair_truth.hpp"
#include "tests/engine/geometry/overlap/pairs.hpp"

namespace isojam {
namespace {

using namespace testing_pairs;
using Eigen::Vector3d;

constexpr double ratios[] = {1.4, 3, 10};

const std::vector<Solid>& unit_solids() {
  static const std::vector<Solid> solids{*Solid::named("tetrahedron"),
                                         *Solid::named("cube"),
                                         *Solid::named("octahedron"),
                                         *Solid::named("truncated_tetrahedron"),
                                         Solid::made_of("rock", points_on_sphere(10, 71)),
                                         *Solid::named("truncated_octahedron"),
                                         Solid::made_of("stone", points_on_sphere(22, 81))};
  return solids;
}

/// Calls `visit` for every pair of kinds at every ratio. A is the larger solid in half of them.
template <class Visit>
void for_each_pair(const Visit& visit) {
  bool a_is_large = false;
  for (const double ratio : ratios) {
    for (const Solid& kind : unit_solids()) {
      const ConvexSolid large(*kind, ratio);
      for (const Solid& small : unit_solids()) {
        a_is_large = !a_is_large;
        a_is_large ? visit(large, *small) : visit(*small, large);
      }
    }
  }
}

TEST(UnlikeSizes, FaceContactsAreAccurate) {
  RandomStream random{91};
  expect_flat_contacts_right([](const auto& visit) { for_each_pair(visit); }, random);
}

TEST(UnlikeSizes, CornersAndCrossedEdgesAreAccurate) {
  RandomStream random{92};
  PointedContacts contacts{.limit = 5e-12};
  for_each_pair([&](const ConvexSolid& a, const ConvexSolid& b) {
    for (const double volume : {1e-3, 1e-6, 1e-9, 1e-12, 1e-15}) {
      const auto approach = (contacts.pairs + contacts.skipped) % 2 == 0 ? corner_over_face : edge_over_edge;
      contacts.expect_right(approach(a, b, random), volume);
    }
  });
  contacts.expect_more_than(600);
  EXPECT_LT(contacts.clipped, contacts.pairs / 50);
}

TEST(UnlikeSizes, HessiansAgreeWithDifferences) {
  RandomStream random{93};
  expect_hessians_of_differences([](const auto& visit) { for_each_pair(visit); }, random, 100);
}

TEST(UnlikeSizes, OneInsideTheOtherIsAccurate) {
  RandomStream random{94};
  double worst = 0;
  int inside = 0;
  for_each_pair([&](const ConvexSolid& a, const ConvexSolid& b) {
    const double room = std::max(a.inradius(), b.inradius()) - std::min(a.circumradius(), b.circumradius());
    if (room <= 0) return;
    for (const double distance : {0.0, 1e-9, .5, .999}) {
      PosedPair pair{a, b, {}, {}};
      pair.at_a.orientation = random_orientation(random), pair.at_b.orientation = random_orientation(random);
      pair.at_b.position = distance * room * random_direction(random);
      const Overlap got = found(pair);
      const double here = std::max({std::abs(got.volume - 1), got.area.norm(), got.moment.norm() / (1 + room)});
      EXPECT_LE(here, 1e-14) << names(a, b) << ", " << distance << " of the way to the surface";
      worst = std::max(worst, here);
      ++inside;
    }
  });
  std::printf("%d inside: %.1e at worst\n", inside, worst);
  EXPECT_GT(inside, 200);
}

}  // namespace
}  // namespace isojam
