#include "engine/analysis/clusters.hpp"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <numeric>
#include <stdexcept>
#include <utility>

namespace isojam {

namespace {

using Eigen::Vector3d;
using Eigen::Vector3i;
using Vector3l = Eigen::Matrix<std::int64_t, 3, 1>;

/// True if `candidate` is linearly independent of `basis`. Integers are exact, because windings are at most N cells
/// long.
bool independent(const std::vector<Vector3i>& basis, const Vector3i& candidate) {
  const Vector3l v = candidate.cast<std::int64_t>();
  if (basis.empty()) return !v.isZero();
  const Vector3l first = basis[0].cast<std::int64_t>();
  if (basis.size() == 1) return !first.cross(v).isZero();
  return basis.size() == 2 && first.cross(basis[1].cast<std::int64_t>()).dot(v) != 0;
}

void add_winding(std::vector<Vector3i>& basis, const Vector3i& winding) {
  if (independent(basis, winding)) basis.push_back(winding);
}

/// Union-find with periodic images. Each link stores the image of a particle relative to its parent, in cells.
class ImageUnion {
 public:
  struct Placed {
    int root;
    Vector3i image;
  };

  explicit ImageUnion(int particles)
      : parent_(particles), size_(particles, 1), image_(particles, Vector3i::Zero()), windings_(particles) {
    std::iota(parent_.begin(), parent_.end(), 0);
  }

  Placed find(int i) const {
    Vector3i image = Vector3i::Zero();
    for (; parent_[i] != i; i = parent_[i]) image += image_[i];
    return {i, image};
  }

  void join(const NeighbourPair& bond) {
    Placed a = find(bond.a), b = find(bond.b);
    // Displacement, in cells, from the image of b that belongs to the root of b to the image of b next to a.
    Vector3i offset = a.image + bond.shift - b.image;
    if (a.root == b.root) {
      add_winding(windings_[a.root], offset);
      return;
    }
    // Union by size, so that no path is longer than log2 N.
    if (size_[a.root] < size_[b.root]) {
      std::swap(a, b);
      offset = -offset;
    }
    parent_[b.root] = a.root;
    image_[b.root] = offset;
    size_[a.root] += size_[b.root];
    for (const Vector3i& winding : windings_[b.root]) add_winding(windings_[a.root], winding);
  }

  const std::vector<Vector3i>& windings(int root) const { return windings_[root]; }

 private:
  std::vector<int> parent_, size_;
  std::vector<Vector3i> image_;  ///< relative to the parent
  std::vector<std::vector<Vector3i>> windings_;
};

/// Distances of the outermost vertices from the centre, below and above it along each axis.
struct Reach {
  Vector3d below, above;
};

Reach reach(const ConvexSolid& solid, const Pose& pose) {
  Reach result{Vector3d::Zero(), Vector3d::Zero()};
  const Eigen::Matrix3d rotation = rotation_matrix(pose).high;
  for (const Vector3d& vertex : solid.vertices()) {
    const Vector3d v = rotation * vertex;
    result.below = result.below.cwiseMin(v);
    result.above = result.above.cwiseMax(v);
  }
  return result;
}

void measure_extents(const Packing& packing, Cluster& cluster) {
  const double infinity = std::numeric_limits<double>::infinity();
  Vector3d low = Vector3d::Constant(infinity), high = -low, body_low = low, body_high = high;
  for (int m = 0; m < cluster.size(); ++m) {
    const Pose& pose = packing.poses[cluster.members[m]];
    const Vector3d centre = pose.position + packing.cell.translation(cluster.images[m]);
    const Reach body = reach(packing.solids[cluster.members[m]], pose);
    low = low.cwiseMin(centre);
    high = high.cwiseMax(centre);
    body_low = body_low.cwiseMin(centre + body.below);
    body_high = body_high.cwiseMax(centre + body.above);
  }
  for (int axis = 0; axis < 3; ++axis) {
    const bool winds = std::any_of(cluster.windings.begin(), cluster.windings.end(), [&](const Vector3i& winding) {
      return packing.cell.translation(winding)[axis] != 0;
    });
    if (winds) continue;
    cluster.extent[axis] = high[axis] - low[axis];
    cluster.body_extent[axis] = body_high[axis] - body_low[axis];
  }
}

}  // namespace

std::optional<double> Cluster::longest_extent() const {
  double longest = 0;
  for (const std::optional<double>& length : extent) {
    if (!length) return std::nullopt;
    longest = std::max(longest, *length);
  }
  return longest;
}

bool Cluster::spans(double side) const {
  const std::optional<double> longest = longest_extent();
  return !longest || *longest >= side;
}

std::vector<Cluster> find_clusters(const Packing& packing, std::span<const NeighbourPair> bonds) {
  ImageUnion particles(packing.size());
  for (const NeighbourPair& bond : bonds) {
    if (bond.a < 0 || bond.b < 0 || bond.a >= packing.size() || bond.b >= packing.size())
      throw std::invalid_argument("a bond refers to a particle that the packing does not contain");
    particles.join(bond);
  }
  std::vector<Cluster> clusters;
  std::vector<int> cluster_of_root(packing.size(), -1);
  std::vector<Vector3i> label_image;
  for (int i = 0; i < packing.size(); ++i) {
    const auto [root, image] = particles.find(i);
    if (cluster_of_root[root] < 0) {  // i is the smallest member
      cluster_of_root[root] = static_cast<int>(clusters.size());
      clusters.emplace_back().windings = particles.windings(root);
      label_image.push_back(image);
    }
    const int c = cluster_of_root[root];
    clusters[c].members.push_back(i);
    clusters[c].images.emplace_back(image - label_image[c]);
  }
  for (Cluster& cluster : clusters) measure_extents(packing, cluster);
  return clusters;
}

std::vector<NeighbourPair> bonds_of(std::span<const Contact> contacts, std::span<const ContactClass> classes,
                                    ContactClass wanted) {
  if (contacts.size() != classes.size()) throw std::invalid_argument("each contact needs one class");
  std::vector<NeighbourPair> bonds;
  for (std::size_t k = 0; k < contacts.size(); ++k) {
    if (classes[k] == wanted) bonds.push_back(contacts[k].pair);
  }
  return bonds;
}

std::vector<int> cluster_labels(std::span<const Cluster> clusters, int particles) {
  std::vector<int> labels(particles, -1);
  for (const Cluster& cluster : clusters) {
    for (const int member : cluster.members) labels.at(member) = cluster.label();
  }
  return labels;
}

}  // namespace isojam
