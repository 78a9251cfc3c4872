// Reference: clipping in quadruple precision. The edge is parallel to the face within a tilt of at most the depth, so
// that the intersection is a strip with a width much smaller than its length.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <vector>

#include "engine/geometry/solids/solid.hpp"
#include "tests/engine/geometry/overlap/pair_truth.hpp"

namespace isojam {
namespace {

using namespace testing_pairs;

/// overlap.hpp: largest relative error of V, S and M.
double bound(const PosedPair& pair, double volume) {
  const double smaller = std::min(pair.a.volume(), pair.b.volume());
  return 1e-12 + 16 * std::numeric_limits<double>::epsilon() * std::sqrt(smaller / volume);
}

TEST(Strips, HaveErrorsWithinTheBound) {
  RandomStream random{77};
  std::vector<Solid> solids(all_solids.begin(), all_solids.end());
  for (const auto* name : {"prism7", "truncated_octahedron"}) solids.push_back(*Solid::named(name));
  double worst = 0;
  for (const double volume : {1e-4, 1e-6, 1e-8, 1e-10, 1e-12, 1e-14, 1e-16, 1e-18, 1e-20}) {
    double largest = 0, share = 0;
    int pairs = 0, skipped = 0;
    for (const Solid& a : solids) {
      for (const Solid& b : solids) {
        for (const double ratio : {1.0, 3.0, 10.0}) {
          const ConvexSolid large(*a, ratio);
          const double tilt = std::sqrt(volume) * std::pow(10, -3 * random.uniform());
          const auto pair = at_volume(edge_in_face(large, *b, tilt, random), volume);
          if (!pair) ++skipped;
          if (!pair) continue;
          ++pairs;
          const double here = error(*pair);
          EXPECT_LE(here, bound(*pair, volume)) << names(large, *b) << ", V " << volume;
          largest = std::max(largest, here);
          share = std::max(share, here / bound(*pair, volume));
        }
      }
    }
    std::printf("V %.0e: error up to %.1e, up to %.2f of the bound; %d pairs, %d not made\n", volume, largest, share,
                pairs, skipped);
    EXPECT_GT(pairs, 100);
    worst = std::max(worst, largest);
  }
  EXPECT_GT(worst, 1e-12);
}

}  // namespace
}  // namespace isojam
