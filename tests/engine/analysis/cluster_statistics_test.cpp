#include "engine/analysis/cluster_statistics.hpp"

#include <gtest/gtest.h>

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
    Structure structure = at(20, row(11, 1));
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
      chain.packing.poses[1].position.x() -= 60;  // stored on the other side of the boundary
      chain.bonds[0].shift.x() = 1, chain.bonds[1].shift.x() = -1;
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
