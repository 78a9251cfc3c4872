// Reference: a search over many images.

#include "engine/packing/neighbours.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

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
