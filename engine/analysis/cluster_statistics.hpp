#pragma once

#include <array>
#include <optional>
#include <span>
#include <string_view>

#include "engine/analysis/clusters.hpp"
#include "engine/names/enum_names.hpp"

namespace isojam {

/// Result of a fit of the fractal dimension.
enum class DimensionVerdict {
  not_called,
  fitted,
  winds,     ///< the cluster winds: it is connected to its own periodic image, so its size is infinite
  too_small  ///< there are fewer than three radii ℓ (see fractal_dimension()), or all centres coincide
};
template <>
inline constexpr std::array enum_names<DimensionVerdict>{
    EnumName{DimensionVerdict::not_called, "not_called"}, EnumName{DimensionVerdict::fitted, "fitted"},
    EnumName{DimensionVerdict::winds, "winds"}, EnumName{DimensionVerdict::too_small, "too_small"}};

/// Fractal dimension D of connected pieces of a cluster: s ∝ ρ^D for pieces of s particles with the size ρ.
struct FractalDimension {
  DimensionVerdict verdict = DimensionVerdict::not_called;  ///< result of the fit
  double D = 0;      ///< fractal dimension, the slope of the fitted line; 0 unless the verdict is `fitted`
  double error = 0;  ///< standard error of the slope, from the scatter of the points about the line
  int points = 0;    ///< number of radii ℓ in the fit
};

/// Fits D to pieces of one cluster. A piece consists of all particles that are at most ℓ bonds away from a given
/// member. For each member, ℓ = 1, 2, … is increased until the piece is the whole cluster. For each ℓ, the means of log
/// ρ and log s over all members are one point of the fit; all points have equal weights. The size ρ of a piece is
/// defined by ρ² = R_g² + a²/12, where R_g is the radius of gyration of the centres and a² is the mean square length of
/// a bond. The second term replaces each particle by a rod with the length of a bond. Straight chains of any length
/// then have exactly D = 1. The pieces overlap, so the error describes only the fitted line, and not the spread of D
/// between similar clusters. `bonds` may contain bonds of other clusters. For a cluster of n particles, the time is
/// O(n²·bonds per particle).
FractalDimension fractal_dimension(const Packing& packing, const Cluster& cluster,
                                   std::span<const NeighbourPair> bonds);

/// Sizes and extents of the clusters of a packing, as in the paper's Table IV. L is the side of the cell
/// (PeriodicCell::side()).
struct ClusterStatistics {
  /// mean size Σs²/Σs; the sums are over all clusters, s is the number of particles of a cluster, and single particles
  /// are clusters too
  double S = 0;
  int largest = 0;       ///< number of particles in the largest cluster
  int winding_rank = 0;  ///< largest winding_rank() of a cluster; 0 if no cluster percolates
  bool spans = false;    ///< true if Cluster::spans() is true for at least one cluster
  /// Index of the cluster with the largest extent between centres. If a cluster winds, it is the index of the first
  /// cluster that winds.
  int longest = -1;
  /// Largest extent of any cluster along an axis, divided by L: l_max between centres, and body_l_max between vertices.
  /// nullopt if a cluster winds.
  std::optional<double> l_max, body_l_max;
  FractalDimension D_max;  ///< fractal dimension of the cluster `longest`
};

/// Computes the statistics. `clusters` must be the result of find_clusters(packing, bonds). Throws
/// std::invalid_argument if `clusters` is empty.
ClusterStatistics cluster_statistics(const Packing& packing, std::span<const NeighbourPair> bonds,
                                     std::span<const Cluster> clusters);

}  // namespace isojam
