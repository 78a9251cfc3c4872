#pragma once

#include <array>
#include <optional>
#include <span>
#include <string_view>

#include "engine/analysis/clusters.hpp"
#include "engine/names/enum_names.hpp"

namespace isojam {

/// Result of fitting a cluster's fractal dimension.
enum class DimensionVerdict {
  not_called,
  fitted,
  winds,     ///< the cluster closes on itself through the periodic boundary and has no size
  too_small  ///< pieces of fewer than three radii, or without extent: a line has no error
};
template <>
inline constexpr std::array enum_names<DimensionVerdict>{
    EnumName{DimensionVerdict::not_called, "not_called"}, EnumName{DimensionVerdict::fitted, "fitted"},
    EnumName{DimensionVerdict::winds, "winds"}, EnumName{DimensionVerdict::too_small, "too_small"}};

/// Fractal dimension D, s ∝ ρ^D, of connected pieces with s particles and size ρ.
struct FractalDimension {
  DimensionVerdict verdict = DimensionVerdict::not_called;  ///< result of the fit
  double D = 0;                                             ///< the slope; 0 unless fitted
  double error = 0;  ///< standard error of the slope, from the scatter about the line
  int points = 0;    ///< number of radii ℓ in the fit
};

/// Fits D to pieces of one cluster. A piece consists of all particles within ℓ bonds of a member, ℓ = 1, 2, ... until a
/// piece is the whole cluster. The line fits the means over the members of log ρ and log s at each ℓ, with equal
/// weights. ρ² = R_g² + a²/12, R_g the radius of gyration of the centres and a² the mean square bond length. Each
/// particle is thus replaced by a rod of the length of a bond, so that straight chains of any length have exactly D =
/// 1. Since pieces overlap, the error is that of the line, not that of D for similar clusters. `bonds` may include
/// those of other clusters. O(s²·bonds per particle).
FractalDimension fractal_dimension(const Packing& packing, const Cluster& cluster,
                                   std::span<const NeighbourPair> bonds);

/// Sizes and extents of clusters of face-face contacts, as in the paper's Table IV; lengths in L.
struct ClusterStatistics {
  double S = 0;     ///< mean size of the cluster of a particle, Σs²/Σs over clusters, including single particles
  int largest = 0;  ///< number of particles in the largest cluster
  int winding_rank = 0;  ///< largest winding rank of a cluster; 0 means no periodic percolation
  bool spans = false;    ///< true if some cluster is as long as the cell, or winds
  int longest = -1;      ///< index of the cluster with the largest extent; the first one that winds, if any
  /// Largest extent of any cluster along a Cartesian axis over L, between centres and between vertices. nullopt if a
  /// cluster winds.
  std::optional<double> l_max, body_l_max;
  FractalDimension D_max;  ///< fractal dimension of the longest cluster
};

/// Statistics of `clusters`, the result of find_clusters(packing, bonds). Throws std::invalid_argument if it is empty.
ClusterStatistics cluster_statistics(const Packing& packing, std::span<const NeighbourPair> bonds,
                                     std::span<const Cluster> clusters);

}  // namespace isojam
