#include "tests/engine/analysis/constructed_clusters.hpp"

namespace isojam::constructed {

using Eigen::Vector3d;
using Eigen::Vector3i;

Structure at(double cell_side, const std::vector<Vector3d>& centres) {
  Structure structure{{platonic(SolidKind::cube), PeriodicCell(cell_side), {}}, {}};
  for (const Vector3d& centre : centres) structure.packing.poses.push_back({.position = centre});
  return structure;
}

std::vector<Vector3d> row(int n, int axis) {
  std::vector<Vector3d> centres;
  for (int k = 0; k < n; ++k) centres.push_back(k * Vector3d::Unit(axis));
  return centres;
}

void add_chain(Structure& structure, int from, int to) {
  for (int k = from; k + 1 < to; ++k) structure.bonds.push_back({k, k + 1, Vector3i::Zero()});
}

Structure block(const Vector3i& n, const std::array<bool, 3>& periodic, double cell_side) {
  std::vector<Vector3d> centres;
  for (int k = 0; k < n.prod(); ++k) centres.emplace_back(k % n[0], k / n[0] % n[1], k / n[0] / n[1]);
  Structure structure = at(cell_side, centres);
  const Vector3i stride(1, n[0], n[0] * n[1]);
  for (int k = 0; k < n.prod(); ++k) {
    for (int axis = 0; axis < 3; ++axis) {
      const bool last = static_cast<int>(centres[k][axis]) == n[axis] - 1;
      if (!last) structure.bonds.push_back({k, k + stride[axis], Vector3i::Zero()});
      if (last && periodic[axis])
        structure.bonds.push_back({k, k - (n[axis] - 1) * stride[axis], Vector3i::Unit(axis)});
    }
  }
  return structure;
}

std::vector<Cluster> clusters_of(const Structure& structure) {
  return find_clusters(structure.packing, structure.bonds);
}

ClusterStatistics statistics_of(const Structure& structure) {
  return cluster_statistics(structure.packing, structure.bonds, clusters_of(structure));
}

}  // namespace isojam::constructed
