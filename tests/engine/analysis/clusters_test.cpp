#include "engine/analysis/clusters.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <map>
#include <numbers>

#include "engine/analysis/cluster_statistics.hpp"
#include "engine/random/stream.hpp"
#include "tests/engine/analysis/constructed_clusters.hpp"

namespace isojam {
namespace {

using Eigen::Vector3d;
using Eigen::Vector3i;

using constructed::add_chain;
using constructed::at;
using constructed::block;
using constructed::clusters_of;
using constructed::row;
using constructed::statistics_of;
using constructed::Structure;

/// Random centres in the cell, and random bonds between them with shifts of up to one cell.
Structure random_structure(int particles, int bonds, RandomStream& random) {
  std::vector<Vector3d> centres;
  for (int k = 0; k < particles; ++k)
    centres.emplace_back(5 * random.uniform(), 5 * random.uniform(), 5 * random.uniform());
  Structure structure = at(5, centres);
  const auto any = [&](int n) { return static_cast<int>(random.uniform() * n); };
  for (int k = 0; k < bonds; ++k) {
    // Most bonds are within the cell, so that some clusters have windings and others have none.
    const auto shift = [&] { return random.uniform() < 0.8 ? 0 : any(3) - 1; };
    const int a = any(particles), b = any(particles);
    const int x = shift(), y = shift(), z = shift();
    structure.bonds.push_back({a, b, Vector3i(x, y, z)});
  }
  return structure;
}

TEST(Clusters, OfAChainThatSpansOrNot) {
  for (const double side : {20.0, 12.0, 11.5, 11.0, 10.0}) {
    Structure structure = at(side, row(12, 1));
    add_chain(structure, 0, 12);
    const std::vector<Cluster> clusters = clusters_of(structure);
    ASSERT_EQ(clusters.size(), 1U);
    EXPECT_EQ(clusters[0].winding_rank(), 0);
    EXPECT_EQ(clusters[0].extent[0], 0);
    EXPECT_EQ(clusters[0].extent[1], 11);
    EXPECT_DOUBLE_EQ(clusters[0].body_extent[1].value(), 12);
    EXPECT_EQ(clusters[0].spans(side), side <= 11) << "side " << side;
    const ClusterStatistics statistics = statistics_of(structure);
    EXPECT_DOUBLE_EQ(statistics.l_max.value(), 11 / side);
    EXPECT_DOUBLE_EQ(statistics.body_l_max.value(), 12 / side);
    EXPECT_EQ(statistics.S, 12);
    EXPECT_EQ(statistics.spans, side <= 11);
  }
}

TEST(Clusters, ThroughTheBoundaryHaveTheirWindings) {
  for (int mask = 0; mask < 8; ++mask) {
    const std::array<bool, 3> closed{(mask & 1) != 0, (mask & 2) != 0, (mask & 4) != 0};
    const Structure structure = block({4, 4, 4}, closed, 4);
    const std::vector<Cluster> clusters = clusters_of(structure);
    ASSERT_EQ(clusters.size(), 1U);
    EXPECT_EQ(clusters[0].size(), 64);
    EXPECT_EQ(clusters[0].winding_rank(), closed[0] + closed[1] + closed[2]);
    for (int axis = 0; axis < 3; ++axis) {
      EXPECT_EQ(clusters[0].extent[axis].has_value(), !closed[axis]) << "mask " << mask << ", axis " << axis;
      if (!closed[axis]) {
        EXPECT_EQ(clusters[0].extent[axis], 3);
      }
    }
    EXPECT_EQ(clusters[0].spans(4), mask != 0) << "three lattice constants are less than the cell";
    const ClusterStatistics statistics = statistics_of(structure);
    EXPECT_EQ(statistics.l_max.has_value(), mask == 0);
    EXPECT_EQ(statistics.winding_rank, clusters[0].winding_rank());
    EXPECT_EQ(statistics.D_max.verdict, mask == 0 ? DimensionVerdict::fitted : DimensionVerdict::winds);
  }
}

TEST(Clusters, HelixWindsOnlyWhenItsEndsMeet) {
  constexpr int per_turn = 8, turns = 3, n = per_turn * turns;
  constexpr double side = 12, radius = 2;
  std::vector<Vector3d> centres;
  for (int k = 0; k < n; ++k) {
    const double angle = 2 * std::numbers::pi * k / per_turn;
    centres.emplace_back(radius * std::cos(angle), radius * std::sin(angle), side * k / n);
  }
  Structure helix = at(side, centres);
  add_chain(helix, 0, n);
  const Cluster open = clusters_of(helix).front();
  EXPECT_EQ(open.winding_rank(), 0);
  EXPECT_DOUBLE_EQ(open.extent[0].value(), 2 * radius);
  EXPECT_DOUBLE_EQ(open.extent[2].value(), side * (n - 1) / n);
  EXPECT_FALSE(open.spans(side));
  helix.bonds.push_back({n - 1, 0, Vector3i::UnitZ()});
  const Cluster closed = clusters_of(helix).front();
  ASSERT_EQ(closed.winding_rank(), 1);
  EXPECT_EQ(closed.windings[0].cwiseAbs(), Vector3i(Vector3i::UnitZ()));
  EXPECT_DOUBLE_EQ(closed.extent[0].value(), 2 * radius) << "no winding in this direction";
  EXPECT_FALSE(closed.extent[2]);
}

TEST(Clusters, WindingsOfAllClosedPathsAreFound) {
  Structure alone = at(3, row(1, 0));
  alone.bonds.push_back({0, 0, Vector3i::UnitX()});
  EXPECT_EQ(clusters_of(alone).front().winding_rank(), 1);
  alone.bonds.push_back({0, 0, {-2, 0, 0}});
  EXPECT_EQ(clusters_of(alone).front().winding_rank(), 1) << "a double turn is the same direction";
  alone.bonds.push_back({0, 0, {1, 2, 0}});
  EXPECT_EQ(clusters_of(alone).front().winding_rank(), 2);
  alone.bonds.push_back({0, 0, {3, 2, 0}});
  EXPECT_EQ(clusters_of(alone).front().winding_rank(), 2) << "in the plane of the others";
  alone.bonds.push_back({0, 0, {3, 2, 1}});
  EXPECT_EQ(clusters_of(alone).front().winding_rank(), 3);

  // Two strands, one out through the boundary and one back. They form a closed path that does not end at another image.
  Structure back_and_forth = at(4, row(4, 0));
  add_chain(back_and_forth, 0, 4);
  back_and_forth.bonds.push_back({3, 0, Vector3i::UnitX()});
  EXPECT_EQ(clusters_of(back_and_forth).front().winding_rank(), 1);
  Structure returning = at(4, row(4, 0));
  returning.bonds = {
      {0, 1, Vector3i::UnitX()}, {1, 2, Vector3i::Zero()}, {2, 3, -Vector3i::UnitX()}, {3, 0, Vector3i::Zero()}};
  EXPECT_EQ(clusters_of(returning).front().winding_rank(), 0);
  EXPECT_EQ(clusters_of(returning).front().extent[0], 6) << "0, 5, 6, 3 unwrapped";
}

/// For each particle: the label, the image and the windings of its cluster, from a breadth-first search.
struct Searched {
  std::vector<int> label;
  std::map<int, std::vector<Vector3d>> cycles;
};

Searched search(const Structure& structure) {
  const int n = structure.packing.size();
  Searched result{std::vector<int>(n, -1), {}};
  std::vector<Vector3i> image(n, Vector3i::Zero());
  for (int start = 0; start < n; ++start) {
    if (result.label[start] >= 0) continue;
    std::vector<int> queue{start};
    result.label[start] = start;
    for (std::size_t k = 0; k < queue.size(); ++k) {
      for (const NeighbourPair& bond : structure.bonds) {
        for (const int sign : {1, -1}) {
          const int from = sign > 0 ? bond.a : bond.b, to = sign > 0 ? bond.b : bond.a;
          if (from != queue[k]) continue;
          const Vector3i there = image[from] + sign * bond.shift;
          if (result.label[to] < 0) {
            result.label[to] = start;
            image[to] = there;
            queue.push_back(to);
          } else {
            result.cycles[start].push_back((there - image[to]).cast<double>());
          }
        }
      }
    }
  }
  return result;
}

long rank_of(const std::vector<Vector3d>& cycles) {
  if (cycles.empty()) return 0;
  Eigen::MatrixXd matrix(3, static_cast<long>(cycles.size()));
  for (std::size_t k = 0; k < cycles.size(); ++k) matrix.col(static_cast<long>(k)) = cycles[k];
  return Eigen::FullPivLU<Eigen::MatrixXd>(matrix).rank();
}

TEST(Clusters, OfRandomBondsAgreeWithASearch) {
  RandomStream random{31};
  std::array<int, 4> ranks{};
  for (int trial = 0; trial < 400; ++trial) {
    const int particles = 1 + static_cast<int>(40 * random.uniform());
    const Structure structure =
        random_structure(particles, static_cast<int>(1.2 * particles * random.uniform()), random);
    Searched expected = search(structure);
    const std::vector<Cluster> clusters = clusters_of(structure);
    EXPECT_EQ(cluster_labels(clusters, particles), expected.label) << "trial " << trial;
    for (const Cluster& cluster : clusters) {
      EXPECT_EQ(cluster.winding_rank(), rank_of(expected.cycles[cluster.label()])) << "trial " << trial;
      ++ranks[cluster.winding_rank()];
    }
  }
  for (const int count : ranks) EXPECT_GT(count, 10) << "the bonds should give clusters of every rank";
}

}  // namespace
}  // namespace isojam
