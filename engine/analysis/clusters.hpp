#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <span>
#include <vector>

#include "engine/analysis/contacts.hpp"
#include "engine/packing/neighbours.hpp"

namespace isojam {

/// A cluster: particles that are connected by bonds, directly or through other particles. A cluster winds (percolates)
/// if a path along bonds connects a particle with a periodic image of itself. The displacement to this image is called
/// a winding. All windings of a cluster, in units of the lattice vectors, form a lattice.
struct Cluster {
  std::vector<int> members;  ///< indices of the particles, ascending; the first one is the label of the cluster
  /// For each member, the periodic image that is reached along bonds from the first member. The centre of this image is
  /// x + h·image, where the columns of h are the lattice vectors. If the cluster winds, several images can be reached;
  /// one of them is stored.
  std::vector<Eigen::Vector3i> images;
  /// Linearly independent windings; empty if the cluster does not wind. Their number is the dimension of the lattice of
  /// windings.
  std::vector<Eigen::Vector3i> windings;
  /// Extents along x, y and z between the outermost centres (V_p^(1/3)). The cluster is followed along its bonds across
  /// the periodic boundaries. nullopt for each axis along which the cluster winds, because the extent is then infinite.
  std::array<std::optional<double>, 3> extent;
  /// extents along x, y and z between the outermost vertices; nullopt where `extent` is nullopt
  std::array<std::optional<double>, 3> body_extent;

  int size() const { return static_cast<int>(members.size()); }  ///< number of particles
  int label() const { return members.front(); }  ///< index of the first particle, which identifies the cluster
  /// Dimension of the lattice of windings, 0 to 3. The cluster percolates if it is not 0.
  int winding_rank() const { return static_cast<int>(windings.size()); }
  /// True if the cluster winds, or if its extent along an axis is at least `side`, which is PeriodicCell::side(). A
  /// cluster can span the cell without winding.
  bool spans(double side) const;
  /// The largest extent between centres along an axis; nullopt if the cluster winds.
  std::optional<double> longest_extent() const;
};

/// Finds all clusters of the packing, including single particles, sorted by label. Bonds may have any order and
/// direction, and may occur several times. A bond of a particle with its own image is a winding. The method is
/// union-find: every particle stores its image relative to the root of its cluster as integers, so windings are exact.
/// The time is O((N + bonds) log N). Throws std::invalid_argument if a bond contains an index that no particle has.
std::vector<Cluster> find_clusters(const Packing& packing, std::span<const NeighbourPair> bonds);

/// The pairs of all contacts of the class `wanted`. Throws std::invalid_argument unless `classes` has one element per
/// contact.
std::vector<NeighbourPair> bonds_of(std::span<const Contact> contacts, std::span<const ContactClass> classes,
                                    ContactClass wanted = ContactClass::face_face);

/// The label of the cluster of every particle, or −1 for a particle in none of the clusters. `particles` is N.
std::vector<int> cluster_labels(std::span<const Cluster> clusters, int particles);

}  // namespace isojam
