// Reference: clipping in quadruple precision.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>
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

/// Largest difference between the results for `larger` and the results for `pair` multiplied by powers of s, relative
/// to |V|, |S|, |M| and |H|.
double difference(const PosedPair& pair, const PosedPair& larger, double s) {
  OverlapHessian h, scaled_h;
  const Overlap one = found(pair, h), other = found(larger, scaled_h);
  const auto off = [](const auto& p, const auto& q) { return (p - q).norm() / p.norm(); };
  const auto rows = [s](const Matrix6d& block) {
    const Vector6d powers = joined(Vector3d::Ones(), Vector3d::Constant(s));
    return Matrix6d(powers.asDiagonal() * block * powers.asDiagonal() * s);
  };
  return std::max({std::abs(other.volume / (one.volume * s * s * s) - 1), off(Vector3d(one.area * s * s), other.area),
                   off(Vector3d(one.moment * s * s * s), other.moment), off(rows(h.aa), scaled_h.aa),
                   off(rows(h.ab), scaled_h.ab), off(rows(h.bb), scaled_h.bb)});
}

TEST(ScaledPairs, ScaleWithThePowersOfTheSize) {
  RandomStream random{95};
  double worst = 0;
  int pairs = 0;
  for (const auto& [s, limit] : {std::pair(2.0, 0.0), {.25, 0.0}, {1.7, 1e-12}, {.03, 1e-12}}) {
    for (const Solid& kind_a : unit_solids()) {
      for (const Solid& kind_b : unit_solids()) {
        const ConvexSolid a(*kind_a, s), b(*kind_b, s);
        const auto touching = at_volume(random_approach(*kind_a, *kind_b, random), pairs % 2 == 0 ? 1e-3 : 1e-8);
        if (!touching) continue;
        const PosedPair larger{a, b, scaled(touching->at_a, s), scaled(touching->at_b, s)};
        const double here = difference(*touching, larger, s);
        EXPECT_LE(here, limit) << to_string(kind_a) << " and " << to_string(kind_b) << " × " << s;
        worst = std::max(worst, here);
        ++pairs;
      }
    }
  }
  std::printf("%d scaled pairs: %.1e at worst\n", pairs, worst);
  EXPECT_GT(pairs, 150);
}

}  // namespace
}  // namespace isojam
