#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <span>
#include <vector>

#include "engine/analysis/contacts.hpp"
#include "engine/packing/neighbours.hpp"

namespace isojam {

/// Particles connected by bonds, directly or through others. A cluster winds if a path along bonds connects a particle
/// to one of its own periodic images. The displacements of such images, in cells, form a lattice.
struct Cluster {
  std::vector<int> members;  ///< ascending; the first one is the cluster's label
  /// Image of each member on a path along bonds from the label: its centre is at x + h·image, where the columns of h
  /// are the lattice vectors. If the cluster winds, this is one of many choices.
  std::vector<Eigen::Vector3i> images;
  /// Linearly independent windings, in cells: as many as the dimension of the lattice. Empty without periodic closure.
  std::vector<Eigen::Vector3i> windings;
  /// Extent between the outermost centres along x, y, z (V_p^(1/3)), unwrapped along bonds. nullopt along an axis on
  /// which the cluster winds, because it has no end there.
  std::array<std::optional<double>, 3> extent;
  std::array<std::optional<double>, 3> body_extent;  ///< extent between the outermost vertices

  int size() const { return static_cast<int>(members.size()); }  ///< number of particles
  int label() const { return members.front(); }                  ///< its first particle, used as its name
  /// Number of independent directions, 0..3, in which the cluster percolates through the periodic boundary.
  int winding_rank() const { return static_cast<int>(windings.size()); }
  /// True for percolation in a weaker sense: an extent without end, or of at least the side of the cell (V_cell^(1/3)
  /// if the cell is not a cube).
  bool spans(double side) const;
  /// The largest extent between centres; nullopt if the cluster winds.
  std::optional<double> longest_extent() const;
};

/// Finds all clusters of the packing, including single particles, sorted by label. Bonds may have any order and
/// direction, and may be repeated; a bond of a particle with its own image is a winding. The method is union-find,
/// where every particle stores its image relative to its root as integers, so that windings are exact. O((N + bonds)
/// log N). Throws std::invalid_argument if a bond refers to no particle.
std::vector<Cluster> find_clusters(const Packing& packing, std::span<const NeighbourPair> bonds);

/// Bonds of the contacts of one class.
std::vector<NeighbourPair> bonds_of(std::span<const Contact> contacts, std::span<const ContactClass> classes,
                                    ContactClass wanted = ContactClass::face_face);

/// Cluster label of every particle.
std::vector<int> cluster_labels(std::span<const Cluster> clusters, int particles);

}  // namespace isojam
