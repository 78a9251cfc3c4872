#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <optional>
#include <string>
#include <vector>

#include "tests/engine/geometry/overlap/exact_pairs.hpp"

// Requirements on overlap() for each family of solids. A family is a function for_each_pair(use), which calls use(a, b)
// for each of its pairs.

namespace isojam::testing_pairs {

/// Text with the names and sizes of both solids, such as "cube (1) and rock (0.1)".
inline std::string names(const ConvexSolid& a, const ConvexSolid& b) {
  return a.name() + " (" + std::to_string(a.scale()) + ") and " + b.name() + " (" + std::to_string(b.scale()) + ")";
}

/// For face-face contacts with depths from 1e-4 to 1e-12 and angles of the same size, the errors of V, S and M are at
/// most 1e-13. The median error is at most 1e-15. Clipping is used for fewer than one in fifty pairs, and the contact
/// loop for all others.
template <class Family>
void expect_flat_contacts_right(const Family& for_each_pair, RandomStream& random) {
  std::vector<double> errors;
  int clipped = 0;
  for_each_pair([&](const ConvexSolid& a, const ConvexSolid& b) {
    for (double depth = 1e-4; depth > 5e-13; depth /= 10) {
      const PosedPair pair = flat_contact(a, b, depth, depth * random.uniform(), random);
      clipped += found(pair).path == OverlapPath::clip;
      const double here = error(pair);
      EXPECT_LE(here, 1e-13) << names(a, b) << ", depth " << depth;
      errors.push_back(here);
    }
  });
  std::sort(errors.begin(), errors.end());
  const double middle = errors[errors.size() / 2];
  std::printf("%zu flat contacts: %.1e at worst, %.1e in the middle, %d of them clipped\n", errors.size(),
              errors.back(), middle, clipped);
  EXPECT_LE(middle, 1e-15);
  EXPECT_LT(clipped, static_cast<int>(errors.size()) / 50);
}

/// Tests of contacts with a given V, such as corners over faces, with clipping in quadruple precision as reference.
struct PointedContacts {
  double limit = 1e-12;                     ///< largest error of V, S and M
  bool with_features = false;               ///< true if the features must be those that clipping finds
  int pairs = 0, skipped = 0, clipped = 0;  ///< skipped: without a pair with this V
  double worst = 0;

  /// Tests a pair with this V. Returns its overlap; nullopt if there is no such pair.
  std::optional<Overlap> expect_right(const Approach& approach, double volume) {
    const auto touching = at_volume(approach, volume);
    if (!touching) {
      ++skipped;
      return std::nullopt;
    }
    ++pairs;
    SCOPED_TRACE(testing::Message() << names(touching->a, touching->b) << ", V " << volume);
    const QuadOverlap right = exact(*touching);
    const Overlap got = found(*touching);
    const double here = error(*touching, right, got);
    EXPECT_LE(here, limit);
    worst = std::max(worst, here);
    clipped += got.path == OverlapPath::clip;
    if (with_features) {
      EXPECT_EQ(got.faces_a, right.faces_a);
      EXPECT_EQ(got.faces_b, right.faces_b);
      EXPECT_EQ(got.edges_a, right.edges_a);
      EXPECT_EQ(got.edges_b, right.edges_b);
    }
    return got;
  }

  void expect_more_than(int least) const {
    std::printf("%d pointed contacts: %.1e at worst, %d clipped, %d not made\n", pairs, worst, clipped, skipped);
    EXPECT_GT(pairs, least);
  }
};

/// For each solid that the function `for_each_solid` visits: V is right if it coincides with itself. The errors are at
/// most 1e-14 if it is shifted along an edge, so that faces remain in the same plane.
template <class Solids>
void expect_coincident_right(const Solids& for_each_solid) {
  double worst = 0;
  for_each_solid([&](const ConvexSolid& solid) {
    PosedPair same{solid, solid, {}, {}};
    EXPECT_NEAR(found(same).volume, 1, 1e-14) << solid.name();
    const Edge& edge = solid.edges().front();
    same.at_b.position = .3 * (solid.vertices()[edge.head] - solid.vertices()[edge.tail]);
    const double here = error(same);
    EXPECT_LE(here, 1e-14) << solid.name();
    worst = std::max(worst, here);
  });
  std::printf("faces in each other: %.1e at worst\n", worst);
}

/// For more than `least` pairs, the derivatives of S agree within 1e-8 with differences in quadruple precision.
template <class Family>
void expect_hessians_of_differences(const Family& for_each_pair, RandomStream& random, int least) {
  double worst = 0;
  int pairs = 0;
  for_each_pair([&](const ConvexSolid& a, const ConvexSolid& b) {
    const auto touching = at_volume(random_approach(a, b, random), 1e-3);
    if (!touching) return;
    ++pairs;
    const double here = hessian_error(*touching);
    EXPECT_LE(here, 1e-8) << names(a, b);
    worst = std::max(worst, here);
  });
  std::printf("slopes of S of %d pairs: %.1e at worst\n", pairs, worst);
  EXPECT_GT(pairs, least);
}

}  // namespace isojam::testing_pairs
