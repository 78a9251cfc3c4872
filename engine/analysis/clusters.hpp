#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <span>
#include <vector>

#include "engine/analysis/contacts.hpp"
#include "engine/packing/neighbours.hpp"

namespace isojam {

/// A cluster: particles that are connected by bonds, directly or through other particles. A cluster winds if a path
/// along bonds connects a particle to a periodic image of itself. The displacements of all such images, in units of the
/// cell, form a lattice.
struct Cluster {
  std::vector<int> members;  ///< indices of the particles, ascending; the first one is the label of the cluster
  /// Periodic image of each member that is reached from the label along bonds. The centre of this image is x + h·image,
  /// where the columns of h are the lattice vectors. If the cluster winds, several images can be reached, and one of
  /// them is stored.
  std::vector<Eigen::Vector3i> images;
  /// Linearly independent vectors of the lattice of windings, in units of the cell. Their number is the dimension of
  /// this lattice. Empty if the cluster does not wind.
  std::vector<Eigen::Vector3i> windings;
  /// Extent along x, y and z between the outermost centres (V_p^(1/3)), followed along bonds across the periodic
  /// boundaries. nullopt along an axis along which the cluster winds, because it is infinite there.
  std::array<std::optional<double>, 3> extent;
  std::array<std::optional<double>, 3> body_extent;  ///< extent along x, y and z between the outermost vertices

  int size() const { return static_cast<int>(members.size()); }  ///< number of particles
  int label() const { return members.front(); }  ///< index of the first particle, which identifies the cluster
  /// Number of independent directions, 0..3, in which the cluster winds, that is, percolates.
  int winding_rank() const { return static_cast<int>(windings.size()); }
  /// True if the cluster winds, or if its extent is at least the side of the cell (V_cell^(1/3) if the cell is not a
  /// cube). This is a weaker criterion of percolation.
  bool spans(double side) const;
  /// The largest extent between centres along an axis; nullopt if the cluster winds.
  std::optional<double> longest_extent() const;
};

/// Finds all clusters of the packing, including single particles, sorted by label. Bonds may have any order and
/// direction, and may occur several times. A bond of a particle with its own image is a winding. The method is
/// union-find. Every particle stores its image relative to the root of its cluster as integers, so windings are exact.
/// The time is O((N + bonds) log N). Throws std::invalid_argument if a bond has an index that is not a particle.
std::vector<Cluster> find_clusters(const Packing& packing, std::span<const NeighbourPair> bonds);

/// The contacts of one class as bonds.
std::vector<NeighbourPair> bonds_of(std::span<const Contact> contacts, std::span<const ContactClass> classes,
                                    ContactClass wanted = ContactClass::face_face);

/// The label of the cluster of every particle.
std::vector<int> cluster_labels(std::span<const Cluster> clusters, int particles);

}  // namespace isojam
