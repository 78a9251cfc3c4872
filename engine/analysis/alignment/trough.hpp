#pragma once

#include <array>
#include <span>
#include <string_view>

#include "engine/names/enum_names.hpp"

namespace isojam {

/// Result of find_trough().
enum class TroughVerdict {
  not_called,
  found,     ///< the density has a trough between two populations
  undecided  ///< the density has no trough, or none that is deeper than the noise of the numbers
};
template <>
inline constexpr std::array enum_names<TroughVerdict>{EnumName{TroughVerdict::not_called, "not_called"},
                                                      EnumName{TroughVerdict::found, "found"},
                                                      EnumName{TroughVerdict::undecided, "undecided"}};

/// Trough in the density f of x = log10 θ, between a population of small angles and the other angles. Positions are
/// numbers of bins: a position k is the lower edge of bin k. Densities are in angles per decade.
///
/// Test. Without a trough, f does not decrease within the window, so the number N(x) of angles below x is a convex
/// function. Its greatest convex minorant G consists of straight segments. Let E be the largest excess N − G in a
/// segment, and n the number of angles in the segment. For many angles, E has the same distribution as √n times the
/// maximum of a Brownian excursion, so that E > t √n has the probability
///     P(t) = 2 Σ_{k≥1} (4k²t² − 1) exp(−2k²t²) ≈ 2 (4t² − 1) exp(−2t²)   (K. L. Chung, Ark. Mat. 14, 155 (1976)).
/// The segment with the largest E/√n has a trough if E exceeds its critical value t √n. Here t satisfies
/// m·2 (4t² − 1) exp(−2t²) = 0.05, and m is the number of segments with more than t² angles. Smaller segments are not
/// counted, because they cannot exceed their critical value: if n ≤ t², then E ≤ n ≤ t √n. A density without a trough
/// is therefore misjudged in at most 5 % of all cases.
///
/// Position. In the segment with the largest E/√n, E is reached at the position s where the density falls below its
/// mean in the segment. The angles below s and above s are the two populations. The density is estimated with a
/// Gaussian kernel. Silverman's rule 0.9 min(sd, IQR/1.34) n^(−1/5) is applied to each of the two populations. The
/// standard deviation of the kernel is the larger of the two values, but at least the width of a bin. The cut-off is
/// the minimum between s and the end of the segment.
///
/// Edges. Let the tails of both populations be exponential near the minimum, f = f_min cosh((x − x_min)/a). Each tail
/// has a·f_min/2 angles beyond the minimum. If the cut-off is moved from the minimum to a point where f = (√5/2) f_min,
/// it also crosses a·f_min/2 angles. The edges are where f exceeds the larger of two values. One is (√5/2) f_min.
/// The other is the upper limit of f_min with its Poisson noise: if the kernel at the minimum contains j angles,
/// the upper limit of this number is j + 1 + √(j + 3/4) (N. Gehrels, Astrophys. J. 303, 336 (1986)). Half of the
/// difference between the constraint numbers at both edges is the systematic error of the constraint number.
struct Trough {
  TroughVerdict verdict = TroughVerdict::not_called;  ///< result of the search
  /// Positions of the minimum and of the edges of the trough, with low ≤ cutoff ≤ high; 0 unless the verdict is found.
  int cutoff = 0, low = 0, high = 0;
  double density = 0;  ///< density f_min at the cut-off
  /// 1 − f_min/f, with f the density at the lower of the two peaks of the populations; 1 if the trough is empty
  double depth = 0;
  double kernel = 0;    ///< standard deviation of the kernel, in decades
  double excess = 0;    ///< E of the segment with the largest E/√n
  double critical = 0;  ///< value that the excess must exceed
};

/// Finds the trough of the density. Element k of `counts` is the number of angles in bin k; bins have the width 1/20 of
/// a decade. The trough must be in the first `window` bins. The result does not depend on the position of the bins: if
/// zeros are put before all numbers, only positions change. Throws std::invalid_argument if a number is negative or not
/// finite, or if there are fewer than `window` bins.
Trough find_trough(std::span<const double> counts, int window);

}  // namespace isojam
