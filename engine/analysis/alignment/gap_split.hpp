#pragma once

#include <array>
#include <span>
#include <string_view>

#include "engine/names/enum_names.hpp"

namespace isojam {

/// Result of split_at_gap().
enum class GapVerdict {
  not_called,
  separated,  ///< the angles form two groups with a gap between them
  all_alike,  ///< all angles form one group, whose distance from `upper` in log θ is larger than its width
  no_gap,     ///< no division into two groups separates them better than for a uniform distribution of log θ
  /// there are fewer than 10 angles below `upper`; analyse_contacts() also sets this verdict if `upper` is below the
  /// accuracy of the angles
  too_few
};
template <>
inline constexpr std::array enum_names<GapVerdict>{
    EnumName{GapVerdict::not_called, "not_called"}, EnumName{GapVerdict::separated, "separated"},
    EnumName{GapVerdict::all_alike, "all_alike"}, EnumName{GapVerdict::no_gap, "no_gap"},
    EnumName{GapVerdict::too_few, "too_few"}};

/// Options of split_at_gap().
struct GapOptions {
  /// Accuracy of alignment angles of parallel features (radians). Smaller angles are replaced by this value.
  double resolution = 1e-12;
  /// Quantile of the normal distribution for GapSplit::critical. With this value, about one of twenty sets of angles
  /// without a gap is wrongly classified as separated.
  double quantile = 1.645;
};

/// Division of the angles below `upper` into two groups by Otsu's criterion, with x = log θ. The variance between the
/// groups is a fraction η = w_0 w_1 (μ_1 − μ_0)²/σ² of the total variance σ². w_0 and w_1 are the fractions of the
/// angles that are in the two groups, and μ_0 and μ_1 are the means of x in the two groups. The groups are divided
/// where η is largest.
struct GapSplit {
  GapVerdict verdict = GapVerdict::not_called;  ///< result of the search
  /// cut-off in radians, the middle of the gap in log θ; 0 unless the verdict is separated or all_alike
  double cutoff = 0;
  double separation = 0;  ///< largest fraction η
  /// Value that η must exceed for the verdict `separated`: 3/4 + quantile·√(0.075/n) for n angles below `upper`.
  /// Reason: if the logarithms are uniformly distributed, η has the mean 3/4 and the standard deviation √(0.075/n). The
  /// standard deviation is computed to first order: one angle changes η by (4u − 3u² − 1)·3/(4n), with u uniform
  /// between 0 and 1. A distribution ∝ θ^p without a gap gives a smaller η: the logarithms are then distributed
  /// exponentially, and η = max t²/(e^t − 1) = 0.648 for any p.
  double critical = 0;
  int below = 0;  ///< number of angles below the cut-off
};

/// Finds a gap that divides the angles into two groups. Near jamming, the angles of face-face contacts are smaller than
/// all other angles by orders of magnitude. The method does not assume a form of their distribution. `angles` are in
/// radians and may have any order. Angles from `upper` on are ignored; usually, `upper` is half of the smallest
/// critical angle. Throws std::invalid_argument if an angle is negative or not finite, or unless 0 < resolution <
/// upper.
GapSplit split_at_gap(std::span<const double> angles, double upper, const GapOptions& options = {});

}  // namespace isojam
