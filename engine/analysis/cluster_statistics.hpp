#pragma once

#include <array>
#include <optional>
#include <span>
#include <string_view>

#include "engine/analysis/clusters.hpp"
#include "engine/names/enum_names.hpp"

namespace isojam {

/// Whether a cluster has a dimension.
enum class DimensionVerdict {
  not_called,
  fitted,
  winds,     ///< the cluster closes on itself through the boundary and has no size
  too_small  ///< pieces of fewer than three radii, or of no extent: no line through them has an error
};
template <>
inline constexpr std::array enum_names<DimensionVerdict>{
    EnumName{DimensionVerdict::not_called, "not_called"}, EnumName{DimensionVerdict::fitted, "fitted"},
    EnumName{DimensionVerdict::winds, "winds"}, EnumName{DimensionVerdict::too_small, "too_small"}};

/// Fractal dimension D, s ∝ ρ^D, of connected pieces of s particles and size ρ.
struct FractalDimension {
  DimensionVerdict verdict = DimensionVerdict::not_called;  ///< whether there is one, and why not
  double D = 0;                                             ///< the slope; 0 unless fitted
  double error = 0;  ///< standard error of the slope from the scatter about the line
  int points = 0;    ///< radii ℓ that the line was fitted to
};

/// Fits D to pieces of one cluster: all that lies within ℓ bonds of a member, ℓ = 1, 2, ... until a piece is the whole
/// cluster; the line goes through the means over the members of log ρ and log s at each ℓ, with equal weights.
/// ρ² = R_g² + a²/12, R_g the radius of gyration of the centres and a² the mean square of bond lengths: each particle
/// stands for a rod of the length of a bond, so that straight chains have D = 1 exactly whatever their length.
/// Pieces overlap, hence the error is that of the line, not of D over clusters like this one.
/// `bonds` may contain those of other clusters. O(s²·bonds per particle).
FractalDimension fractal_dimension(const Packing& packing, const Cluster& cluster,
                                   std::span<const NeighbourPair> bonds);

/// Sizes and extents of clusters of face-face contacts, the paper's Table IV; lengths in L.
struct ClusterStatistics {
  double S = 0;          ///< mean size of the cluster of a particle, Σs²/Σs over clusters, lone particles too
  int largest = 0;       ///< particles of the largest cluster
  int winding_rank = 0;  ///< greatest of the clusters: 0 is no periodic percolation
  bool spans = false;    ///< some cluster is as long as the cell, or winds
  int longest = -1;      ///< index of the cluster of the greatest extent; the first that winds, if one does
  /// Greatest extent between centres, and between vertices of any cluster, along a Cartesian axis over L. None if a
  /// cluster winds.
  std::optional<double> l_max, body_l_max;
  FractalDimension D_max;  ///< of the longest cluster
};

/// Statistics of `clusters`, which are find_clusters(packing, bonds). Throws std::invalid_argument if there are none.
ClusterStatistics cluster_statistics(const Packing& packing, std::span<const NeighbourPair> bonds,
                                     std::span<const Cluster> clusters);

}  // namespace isojam
