#pragma once

#include <array>
#include <span>
#include <string_view>

#include "engine/names/enum_names.hpp"

namespace isojam {

/// Result of a search for a gap.
enum class GapVerdict {
  not_called,
  separated,  ///< there are two groups of angles with a gap between them
  all_alike,  ///< there is one group, and its distance from `upper` in log θ is greater than its width
  no_gap,     ///< the two groups are not separated better than in a uniform distribution of log θ
  too_few     ///< there are fewer than 10 angles below `upper`
};
template <>
inline constexpr std::array enum_names<GapVerdict>{
    EnumName{GapVerdict::not_called, "not_called"}, EnumName{GapVerdict::separated, "separated"},
    EnumName{GapVerdict::all_alike, "all_alike"}, EnumName{GapVerdict::no_gap, "no_gap"},
    EnumName{GapVerdict::too_few, "too_few"}};

/// Parameters that distinguish a gap from noise.
struct GapOptions {
  /// Accuracy of alignment() for parallel features (radians). Smaller angles are replaced by this value.
  double resolution = 1e-12;
  /// One-sided quantile of the normal distribution. With this value, about one of twenty sets of angles without a gap
  /// is wrongly classified as separated.
  double quantile = 1.645;
};

/// Division of the angles below `upper` into two groups by Otsu's criterion. In x = log θ, the variance between the
/// groups is a fraction η = w_0 w_1 (μ_1 − μ_0)²/σ² of the total variance. The groups are divided at the value of x at
/// which η is largest.
struct GapSplit {
  GapVerdict verdict = GapVerdict::not_called;  ///< result of the search
  /// cut-off (radians), the middle of the gap in log θ; 0 unless the verdict is separated or all_alike
  double cutoff = 0;
  double separation = 0;  ///< fraction η of the variance
  /// Value that η must exceed for the verdict `separated`. If the angles follow a power law c ∝ θ^p without a gap,
  /// their logarithms have an exponential distribution. Then η = max t²/(e^t − 1) = 0.648 for any p. If the logarithms
  /// are uniformly distributed, η = 3/4 ± sqrt(0.075/n) for n angles below `upper`. This error is computed to first
  /// order in the influence of each angle, which is (4u − 3u² − 1)·3/4 with u uniform on [0, 1].
  double critical = 0;
  int below = 0;  ///< number of angles below the cut-off
};

/// Finds a gap that divides the angles into two groups. Near jamming, the angles of face-face contacts are smaller than
/// all other angles by orders of magnitude. The method does not assume a form of the distribution c. `angles` are in
/// radians and may have any order. Throws std::invalid_argument if an angle is negative or not finite, or unless 0 <
/// resolution < upper.
GapSplit split_at_gap(std::span<const double> angles, double upper, const GapOptions& options = {});

}  // namespace isojam
