#pragma once

#include <array>
#include <span>
#include <string_view>

#include "engine/names/enum_names.hpp"

namespace isojam {

/// Result of a fit. CdfFit defines c, α, a_0 and `upper`.
enum class FitVerdict {
  not_called,
  fitted,
  /// A cut-off was found, but it is doubtful: the fitted function does not describe c, for example because c has a
  /// second jump. The criterion is that CdfFit::deviation exceeds Kolmogorov's 5 % limit, 1.358/√n for n angles.
  bimodal,
  /// c has no jump: a_0 is less than 2 standard errors above 0, or less than 1/n, the contribution of one of n angles
  /// to c
  collapsed,
  alpha_out_of_range,  ///< α is in the upper half of [0, upper], so no group of angles is near 0
  /// there are fewer angles below `upper` than the five free parameters α and a_0 to a_3, or `upper` is below the
  /// accuracy of the angles
  too_few
};
template <>
inline constexpr std::array enum_names<FitVerdict>{EnumName{FitVerdict::not_called, "not_called"},
                                                   EnumName{FitVerdict::fitted, "fitted"},
                                                   EnumName{FitVerdict::bimodal, "bimodal"},
                                                   EnumName{FitVerdict::collapsed, "collapsed"},
                                                   EnumName{FitVerdict::alpha_out_of_range, "alpha_out_of_range"},
                                                   EnumName{FitVerdict::too_few, "too_few"}};

/// Least-squares fit of a function of the paper, c_f(θ) = H(θ−α)[a_0 − Σ_{n=1..3} a_n (θ−α)^n], to the empirical
/// cumulative distribution c(θ) of alignment angles on [0, upper]. H is the step function, and `upper` is half of the
/// smallest critical angle.
struct CdfFit {
  FitVerdict verdict = FitVerdict::not_called;  ///< result of the fit
  double alpha = 0;                             ///< parameter α, in radians
  double a[4] = {0, 0, 0, 0};                   ///< parameters a_0 to a_3, with a_0 ≤ c(upper)
  double a0_error = 0;  ///< standard error of a_0; the angles above the jump are assumed to be independent
  double error = 0;     ///< squared deviation ∫ (c_f − c)² dθ over [0, upper]
  /// Largest deviation |c_f − c| above the jump, where c ≥ a_0. In 5 % of all sets of n independent angles, c deviates
  /// from the true distribution by more than 1.358/√n. A curve that is fitted to the angles is nearer to c than the
  /// true distribution is. The deviation of the curve therefore exceeds this limit in fewer than 5 % of all sets.
  double deviation = 0;
  /// Cut-off θ_cut in radians, defined by c(θ_cut) = a_0. c is a step function, which is constant between successive
  /// angles. The cut-off is the upper end of the interval on which c is nearest to a_0, and at most `upper`. The
  /// fraction of angles below θ_cut therefore differs from a_0 by at most half a step. `cutoff` is 0 if no cut-off was
  /// found.
  double cutoff = 0;

  /// True if a cut-off was found, even if it is doubtful.
  bool has_cutoff() const { return verdict == FitVerdict::fitted || verdict == FitVerdict::bimodal; }
};

/// Finds the global minimum of CdfFit::error over all parameters, with α in [0, upper). c is integrated exactly.
/// `angles` (radians, in any order) must contain the angles of all contacts, also those above `upper`, because c is
/// normalised by their number. Throws std::invalid_argument if an angle is negative or not finite, or if `upper` is not
/// positive and finite.
CdfFit fit_cdf(std::span<const double> angles, double upper);

}  // namespace isojam
