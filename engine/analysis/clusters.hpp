#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <span>
#include <vector>

#include "engine/analysis/contacts.hpp"
#include "engine/packing/neighbours.hpp"

namespace isojam {

/// Particles joined by bonds, directly or through others. It winds if a path along bonds leads from a particle to one
/// of its own periodic images; the displacements of such images, in cells, form a lattice.
struct Cluster {
  std::vector<int> members;  ///< ascending; the first is the cluster's label
  /// Image of each member: followed along bonds from the label, its centre is at x + h·image, the columns of h
  /// being the lattice vectors. One of many choices if
  /// the cluster winds.
  std::vector<Eigen::Vector3i> images;
  /// Linearly independent windings, in cells: as many as the lattice has dimensions. None: no periodic closure.
  std::vector<Eigen::Vector3i> windings;
  /// Extent between outermost centres along x, y, z (V_p^(1/3)), followed along bonds; none along an axis on which it
  /// winds, where it has no end.
  std::array<std::optional<double>, 3> extent;
  std::array<std::optional<double>, 3> body_extent;  ///< the same between outermost vertices

  int size() const { return static_cast<int>(members.size()); }  ///< number of particles
  int label() const { return members.front(); }                  ///< its first particle, which names it
  /// Percolation by closure through the periodic boundary, in 0..3 independent directions.
  int winding_rank() const { return static_cast<int>(windings.size()); }
  /// Percolation in the weaker sense: an extent without end, or of at least the side of the cell, V_cell^(1/3) where
  /// that is no cube.
  bool spans(double side) const;
  /// The greatest extent between centres; none if it winds.
  std::optional<double> longest_extent() const;
};

/// Finds all clusters of the packing, lone particles too, by label. Bonds in any order and either direction, repeated
/// or not; a bond of a particle with its own image closes a winding. Windings are found by union-find in which every
/// particle carries its image relative to its root, in integers: exact. O((N + bonds) log N).
/// Throws std::invalid_argument if a bond names no particle.
std::vector<Cluster> find_clusters(const Packing& packing, std::span<const NeighbourPair> bonds);

/// Bonds made by the contacts of one class.
std::vector<NeighbourPair> bonds_of(std::span<const Contact> contacts, std::span<const ContactClass> classes,
                                    ContactClass wanted = ContactClass::face_face);

/// Label of the cluster of every particle.
std::vector<int> cluster_labels(std::span<const Cluster> clusters, int particles);

}  // namespace isojam
