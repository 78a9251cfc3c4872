#pragma once

#include <array>
#include <span>
#include <string_view>

#include "engine/names/enum_names.hpp"

namespace isojam {

/// Result of a search for a gap.
enum class GapVerdict {
  not_called,
  separated,  ///< two groups of angles with a gap between them
  all_alike,  ///< one group, farther from `upper` (in log angle) than it is wide
  no_gap,     ///< not better separated than angles spread evenly over the decades
  too_few     ///< fewer than 10 angles below `upper`
};
template <>
inline constexpr std::array enum_names<GapVerdict>{
    EnumName{GapVerdict::not_called, "not_called"}, EnumName{GapVerdict::separated, "separated"},
    EnumName{GapVerdict::all_alike, "all_alike"}, EnumName{GapVerdict::no_gap, "no_gap"},
    EnumName{GapVerdict::too_few, "too_few"}};

/// Criteria that distinguish gaps from noise.
struct GapOptions {
  /// Smaller angles (radians) count as this one: the accuracy of alignment() at zero.
  double resolution = 1e-12;
  /// One-sided normal quantile: about one of twenty sets of angles without a gap is classified as separated.
  double quantile = 1.645;
};

/// Two groups of angles below `upper`, split in x = log θ where the variance between the groups as a fraction of the
/// total, η = w_0 w_1 (μ_1 − μ_0)²/σ², is largest (Otsu's criterion).
struct GapSplit {
  GapVerdict verdict = GapVerdict::not_called;  ///< result
  double cutoff = 0;      ///< radians, the middle of the gap in log θ; 0 unless separated or all_alike
  double separation = 0;  ///< η
  /// Value that η must exceed. For angles without a gap that follow any power law, c ∝ θ^p, η = max t²/(e^t − 1) =
  /// 0.648, because their logarithms are exponentially distributed. For angles spread evenly over decades it is 3/4 ±
  /// sqrt(0.075/n), n angles below `upper` (first order in the influence of each angle, (4u − 3u² − 1)·3/4 with u
  /// uniform on [0, 1]).
  double critical = 0;
  int below = 0;  ///< number of angles below the cut-off
};

/// Splits angles at a gap: near jamming the angles of face-face contacts are decades below the others. No form of c is
/// assumed. Angles may have any order, in radians. Throws std::invalid_argument if one is negative or not finite, or
/// unless 0 < resolution < upper.
GapSplit split_at_gap(std::span<const double> angles, double upper, const GapOptions& options = {});

}  // namespace isojam
