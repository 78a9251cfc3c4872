#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "engine/analysis/cluster_statistics.hpp"

namespace isojam::constructed {

/// Unit cubes parallel to the axes, and bonds between them.
struct Structure {
  Packing packing;
  std::vector<NeighbourPair> bonds;
};

/// Cubes with these centres in a cell with this side, without bonds.
Structure at(double side, const std::vector<Eigen::Vector3d>& centres);

/// n sites along an axis with distance 1.
std::vector<Eigen::Vector3d> row(int n, int axis);

/// Bonds from each of the particles from..to − 1 to the next one.
void add_chain(Structure& structure, int from, int to);

/// All sites of an n[0] × n[1] × n[2] block, bonded along the axes, and through the boundary where `closed`.
Structure block(const Eigen::Vector3i& n, const std::array<bool, 3>& closed, double side);

std::vector<Cluster> clusters_of(const Structure& structure);
ClusterStatistics statistics_of(const Structure& structure);

}  // namespace isojam::constructed
