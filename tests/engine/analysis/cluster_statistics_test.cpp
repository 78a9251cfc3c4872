#include "engine/analysis/cluster_statistics.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "tests/engine/analysis/constructed_clusters.hpp"

namespace isojam {
namespace {

using constructed::add_chain;
using constructed::at;
using constructed::block;
using constructed::row;
using constructed::statistics_of;
using constructed::Structure;
using Eigen::Vector3d;
using Eigen::Vector3i;

TEST(ClusterStatistics, FollowFromSizesAndExtents) {
  // Chains of 5, 3 and 1 particles along y, and optionally a ring of 2 particles through the boundary along x.
  for (const bool ring : {false, true}) {
    std::vector<Vector3d> centres = row(11, 1);
    Structure structure = at(20, centres);
    add_chain(structure, 0, 3);
    add_chain(structure, 3, 8);
    structure.bonds.push_back({9, 10, Vector3i::Zero()});
    if (ring) structure.bonds.push_back({10, 9, Vector3i::UnitX()});
    const ClusterStatistics statistics = statistics_of(structure);
    EXPECT_DOUBLE_EQ(statistics.S, (9 + 25 + 1 + 4) / 11.0);
    EXPECT_EQ(statistics.largest, 5);
    EXPECT_EQ(statistics.longest, ring ? 3 : 1);
    EXPECT_EQ(statistics.winding_rank, ring ? 1 : 0);
    EXPECT_EQ(statistics.spans, ring);
    EXPECT_EQ(statistics.l_max, ring ? std::nullopt : std::optional<double>(4 / 20.0));
    EXPECT_EQ(statistics.D_max.verdict, ring ? DimensionVerdict::winds : DimensionVerdict::fitted);
  }
}

TEST(FractalDimension, OfStraightChainsIsOne) {
  for (const int n : {4, 5, 8, 30}) {
    for (const double bond : {1.0, 0.37}) {
      std::vector<Vector3d> centres;
      for (int k = 0; k < n; ++k) centres.push_back(bond * k * Vector3d(2, -1, 2) / 3);
      Structure chain = at(60, centres);
      add_chain(chain, 0, n);
      const FractalDimension dimension = statistics_of(chain).D_max;
      ASSERT_EQ(dimension.verdict, DimensionVerdict::fitted) << n;
      EXPECT_NEAR(dimension.D, 1, 1e-13) << n;
      EXPECT_NEAR(dimension.error, 0, 1e-13) << n;
      EXPECT_EQ(dimension.points, n - 1);
    }
  }
}

TEST(FractalDimension, OfSheetsAndBlocks) {
  const FractalDimension sheet = statistics_of(block({20, 20, 1}, {}, 60)).D_max;
  const FractalDimension cube = statistics_of(block({9, 9, 9}, {}, 60)).D_max;
  std::printf("sheet %.3f ± %.3f, block %.3f ± %.3f\n", sheet.D, sheet.error, cube.D, cube.error);
  EXPECT_NEAR(sheet.D, 2, 0.06);
  EXPECT_NEAR(cube.D, 3, 0.15);
}

/// Vicsek's cross in three dimensions. At each level, it consists of seven copies of itself in a block with side 3, so
/// D = log 7/log 3.
TEST(FractalDimension, OfASelfSimilarClusterIsExact) {
  std::vector<Vector3d> centres{Vector3d::Zero()};
  for (int level = 0, width = 1; level < 3; ++level, width *= 3) {
    const std::vector<Vector3d> copy = centres;
    for (int axis = 0; axis < 3; ++axis) {
      for (const int sign : {-1, 1}) {
        for (const Vector3d& centre : copy) centres.push_back(centre + sign * width * Vector3d::Unit(axis));
      }
    }
  }
  Structure cross = at(60, centres);
  for (std::size_t a = 0; a < centres.size(); ++a) {
    for (std::size_t b = a + 1; b < centres.size(); ++b) {
      if ((centres[a] - centres[b]).squaredNorm() < 1.5)
        cross.bonds.push_back({static_cast<int>(a), static_cast<int>(b), Vector3i::Zero()});
    }
  }
  const ClusterStatistics statistics = statistics_of(cross);
  EXPECT_EQ(statistics.S, 343);
  const FractalDimension& dimension = statistics.D_max;
  std::printf("cross of %zu: %.3f ± %.3f, closed form %.3f\n", centres.size(), dimension.D, dimension.error,
              std::log(7) / std::log(3));
  EXPECT_NEAR(dimension.D, std::log(7) / std::log(3), 0.1);
}

TEST(FractalDimension, IsUndefinedForSmallOrCoincidentClusters) {
  EXPECT_EQ(FractalDimension().verdict, DimensionVerdict::not_called);
  for (const int n : {1, 2, 3}) {
    Structure chain = at(20, row(n, 0));
    add_chain(chain, 0, n);
    EXPECT_EQ(statistics_of(chain).D_max.verdict, DimensionVerdict::too_small) << n;
  }
  Structure heap = at(20, std::vector<Vector3d>(9, Vector3d::Ones()));
  add_chain(heap, 0, 9);
  EXPECT_EQ(statistics_of(heap).D_max.verdict, DimensionVerdict::too_small);
}

}  // namespace
}  // namespace isojam
