#pragma once

#include <array>
#include <span>
#include <string_view>

#include "engine/names/enum_names.hpp"

namespace isojam {

/// What came of a search for a gap.
enum class GapVerdict {
  not_called,
  separated,  ///< two groups of angles with a gap between
  all_alike,  ///< one group, farther from `upper` (in log angle) than it is wide
  no_gap,     ///< no better separated than angles spread evenly over the decades
  too_few     ///< fewer than 10 angles below `upper`
};
template <>
inline constexpr std::array enum_names<GapVerdict>{
    EnumName{GapVerdict::not_called, "not_called"}, EnumName{GapVerdict::separated, "separated"},
    EnumName{GapVerdict::all_alike, "all_alike"}, EnumName{GapVerdict::no_gap, "no_gap"},
    EnumName{GapVerdict::too_few, "too_few"}};

/// How gaps are told from noise.
struct GapOptions {
  /// Smaller angles (radians) count as this one: what alignment() promises at zero.
  double resolution = 1e-12;
  /// One-sided normal quantile: angles without a gap pass for separated in about one of twenty sets.
  double quantile = 1.645;
};

/// Two groups of angles below `upper`, split in x = log θ where the variance between the groups,
/// η = w_0 w_1 (μ_1 − μ_0)²/σ² as a fraction of the whole, is greatest (Otsu's criterion).
struct GapSplit {
  GapVerdict verdict = GapVerdict::not_called;  ///< whether there is a cut-off, and why not
  double cutoff = 0;      ///< radians, the middle of the gap in log θ; 0 unless separated or all_alike
  double separation = 0;  ///< η
  /// Value that η must exceed. Without a gap, angles that follow any power law, c ∝ θ^p, have
  /// η = max t²/(e^t − 1) = .648, as their logarithms are exponential; angles spread evenly over decades have 3/4 ±
  /// sqrt(.075/n), n angles below `upper` (first order in the influence of each, (4u − 3u² − 1)·3/4 with u uniform on
  /// [0, 1]).
  double critical = 0;
  int below = 0;  ///< angles under the cut-off
};

/// Splits angles where they leave a gap: near jamming face-face contacts lie decades under the others, and no form of c
/// is assumed here. Angles in any order, radians. Throws std::invalid_argument if one is negative or not finite, or
/// unless 0 < resolution < upper.
GapSplit split_at_gap(std::span<const double> angles, double upper, const GapOptions& options = {});

}  // namespace isojam
