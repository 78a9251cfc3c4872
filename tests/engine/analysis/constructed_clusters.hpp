#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "engine/analysis/cluster_statistics.hpp"

namespace isojam::constructed {

/// Unit cubes with faces parallel to those of the cell, and bonds between some of them.
struct Structure {
  Packing packing;
  std::vector<NeighbourPair> bonds;
};

/// Cubes with these centres in a cubic cell, without bonds.
Structure at(double cell_side, const std::vector<Eigen::Vector3d>& centres);

/// n points on a coordinate axis with distance 1, from the origin.
std::vector<Eigen::Vector3d> row(int n, int axis);

/// Adds a bond between every two successive particles with indices from `from` to `to` − 1.
void add_chain(Structure& structure, int from, int to);

/// A block of n[0] × n[1] × n[2] cubes with bonds between neighbours. If `periodic` is true for an axis, bonds also
/// connect the two ends of the block through the face of the cell. If the block has only one cube along such an axis,
/// the bonds connect each cube with its own image. These bonds have a = b, although other NeighbourPairs have a < b.
Structure block(const Eigen::Vector3i& n, const std::array<bool, 3>& periodic, double cell_side);

std::vector<Cluster> clusters_of(const Structure& structure);
ClusterStatistics statistics_of(const Structure& structure);

}  // namespace isojam::constructed
