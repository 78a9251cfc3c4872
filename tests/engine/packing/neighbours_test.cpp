// Reference: a search over many images.

#include "engine/packing/neighbours.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include "tests/engine/packing/packings.hpp"

namespace isojam {
namespace {

using namespace testing_packings;
using Eigen::Vector3d;
using Key = std::array<int, 5>;

Key key(const NeighbourPair& p) { return {p.a, p.b, p.shift[0], p.shift[1], p.shift[2]}; }

std::vector<Key> keys(const std::vector<NeighbourPair>& pairs) {
  std::vector<Key> result;
  for (const NeighbourPair& pair : pairs) result.push_back(key(pair));
  return result;
}

/// Points, some of them several sides outside of the cell. The neighbour search does not check whether solids fit into
/// the cell.
Packing points(int n, double side, std::uint64_t seed) {
  RandomStream random{8, seed};
  Packing packing{platonic(SolidKind::cube), PeriodicCell(side), std::vector<Pose>(static_cast<std::size_t>(n))};
  for (Pose& pose : packing.poses) {
    for (double& x : pose.position) {
      x = side * random.uniform();
      if (random.uniform() < .2) x += side * std::floor(5 * random.uniform() - 2);
    }
  }
  return packing;
}

/// All pairs within reach, by testing every shift in a range that contains all neighbours.
std::vector<Key> all_within(const Packing& packing, double reach) {
  std::vector<Key> result;
  const double side = packing.cell.side();
  for (int a = 0; a < packing.size(); ++a) {
    for (int b = a + 1; b < packing.size(); ++b) {
      const Vector3d d = packing.poses[b].position - packing.poses[a].position;
      std::array<int, 3> low{}, high{};
      for (int c = 0; c < 3; ++c) {
        low[c] = static_cast<int>(std::floor((-reach - d[c]) / side));
        high[c] = static_cast<int>(std::ceil((reach - d[c]) / side));
      }
      for (int i = low[0]; i <= high[0]; ++i) {
        for (int j = low[1]; j <= high[1]; ++j) {
          for (int k = low[2]; k <= high[2]; ++k) {
            if ((d + side * Vector3d(i, j, k)).norm() < reach) result.push_back({a, b, i, j, k});
          }
        }
      }
    }
  }
  return result;
}

TEST(NeighboursTest, AreAllPairsAndImagesWithinReach) {
  const double side = 7;
  for (const int n : {2, 10, 100}) {
    const Packing packing = points(n, side, static_cast<std::uint64_t>(n));
    for (const double fraction : {.1, .2, .3, .45, .55, .8, .9, 1.0, 1.3, 2.2}) {
      const double reach = fraction * side;
      const std::vector<Key> expected = all_within(packing, reach);
      EXPECT_EQ(keys(find_neighbours_brute_force(packing, reach)), expected) << "N " << n << ", reach/L " << fraction;
      EXPECT_EQ(keys(find_neighbours(packing, reach)), expected) << "N " << n << ", reach/L " << fraction;
    }
  }
}

TEST(NeighboursTest, SeveralImagesOccurBeyondHalfTheSide) {
  const Packing packing = points(10, 7, 10);
  std::set<std::pair<int, int>> pairs;
  const std::vector<NeighbourPair> found = find_neighbours(packing, 6.5);
  for (const NeighbourPair& pair : found) pairs.emplace(pair.a, pair.b);
  EXPECT_EQ(pairs.size(), 45U);
  EXPECT_GT(found.size(), 2 * pairs.size());
}

TEST(NeighboursTest, GridSearchAgreesWithTheSearchOverAllPairs) {
  for (const int n : {500, 2000}) {
    const Packing packing = points(n, 12, static_cast<std::uint64_t>(n));
    for (const double reach : {.01, .9, 2.0, 2.7, 3.999, 4.001, 5.9}) {
      const std::vector<Key> by_cells = keys(find_neighbours(packing, reach));
      EXPECT_EQ(by_cells, keys(find_neighbours_brute_force(packing, reach))) << "N " << n << ", reach " << reach;
      EXPECT_TRUE(std::is_sorted(by_cells.begin(), by_cells.end())) << "N " << n << ", reach " << reach;
      EXPECT_EQ(std::adjacent_find(by_cells.begin(), by_cells.end()), by_cells.end()) << "N " << n;
    }
  }
}

TEST(NeighboursTest, DisplacementIsThatOfTheImage) {
  const Packing packing = points(200, 9, 3);
  const double reach = 4;
  for (const NeighbourPair& pair : find_neighbours(packing, reach)) {
    const Vector3d d = displacement(packing, pair);
    EXPECT_LT(d.norm(), reach);
    const Vector3d bare = packing.poses[pair.b].position - packing.poses[pair.a].position;
    EXPECT_LE((d - bare - 9 * pair.shift.cast<double>()).norm(), 8 * epsilon * (bare.norm() + 9));
    EXPECT_LE((d - packing.cell.nearest_image(bare)).norm(), 8 * epsilon * (bare.norm() + 9));
  }
}

/// Points in a cell of any shape.
Packing skew_points(int n, std::uint64_t seed) {
  RandomStream random{9, seed};
  DoubleDoubleMatrix f;
  f.high << 1, .3, -.2, .1, 1.1, .25, -.35, .2, .9;
  f.low(0, 1) = 1e-18;
  Packing packing = deformed(points(n, 7, seed), f);
  packing.cell = packing.cell.reduced();
  return packing;
}

std::vector<std::pair<std::pair<int, int>, double>> distances(const Packing& packing, double reach) {
  std::vector<std::pair<std::pair<int, int>, double>> result;
  for (const NeighbourPair& pair : find_neighbours(packing, reach))
    result.push_back({{pair.a, pair.b}, displacement(packing, pair).norm()});
  std::sort(result.begin(), result.end());
  return result;
}

TEST(NeighboursTest, OfSkewCellsAreAllPairsAndImagesWithinReach) {
  for (const int n : {2, 10, 100, 700}) {
    const Packing packing = skew_points(n, static_cast<std::uint64_t>(n));
    for (const double reach : {.7, 1.4, 2.0, 3.1, 4.0, 7.0}) {
      if (n == 700 && reach > 3) continue;
      std::vector<Key> expected;
      for (int a = 0; a < n; ++a) {
        for (int b = a + 1; b < n; ++b) {
          const Vector3d d = packing.poses[b].position - packing.poses[a].position;
          const Eigen::Vector3i near = packing.cell.nearest_shift(d);
          for (int image = 0; image < 7 * 7 * 7; ++image) {
            const Eigen::Vector3i k = near + Eigen::Vector3i(image % 7 - 3, image / 7 % 7 - 3, image / 49 - 3);
            if ((d + packing.cell.translation(k)).norm() < reach) expected.push_back({a, b, k[0], k[1], k[2]});
          }
        }
      }
      std::sort(expected.begin(), expected.end());
      EXPECT_EQ(keys(find_neighbours_brute_force(packing, reach)), expected) << "N " << n << ", reach " << reach;
      EXPECT_EQ(keys(find_neighbours(packing, reach)), expected) << "N " << n << ", reach " << reach;
    }
  }
}

TEST(NeighboursTest, DoNotDependOnTheVectorsThatSpanTheLattice) {
  const Packing packing = skew_points(60, 5);
  Packing skewer = packing;
  DoubleDoubleMatrix vectors = packing.cell.vectors();
  for (int r = 0; r < 3; ++r) {
    vectors.set(r, 1, vectors(r, 1) + vectors(r, 0) * 2);
    vectors.set(r, 2, vectors(r, 2) - vectors(r, 1));
  }
  skewer.cell = PeriodicCell(vectors);
  for (const double reach : {1.0, 2.5, 4.0}) {
    const auto here = distances(packing, reach), there = distances(skewer, reach);
    ASSERT_EQ(here.size(), there.size()) << reach;
    for (std::size_t k = 0; k < here.size(); ++k) {
      EXPECT_EQ(here[k].first, there[k].first);
      EXPECT_NEAR(here[k].second, there[k].second, 1e-12);
    }
  }
}

TEST(NeighboursTest, LatticePointsOnTheBordersOfGridCellsAreFound) {
  const int m = 6;
  const double spacing = 1.25;
  Packing lattice{platonic(SolidKind::cube), PeriodicCell(m * spacing), {}};
  for (int k = 0; k < m * m * m; ++k) {
    Pose pose;
    // Some points are moved by a whole side. A few coordinates are negative zeros or just below a border.
    const int x = k % m - m * (k % 5 == 0), y = k / m % m, z = k / (m * m);
    pose.position = spacing * Vector3d(x, y, z);
    lattice.poses.push_back(pose);
  }
  const std::size_t n = lattice.poses.size();
  EXPECT_EQ(find_neighbours(lattice, 1.2 * spacing).size(), n * 6 / 2);
  EXPECT_EQ(find_neighbours(lattice, 1.5 * spacing).size(), n * 18 / 2);
  EXPECT_EQ(find_neighbours(lattice, 1.8 * spacing).size(), n * 26 / 2);
}

}  // namespace
}  // namespace isojam
