#pragma once

#include <array>
#include <span>
#include <string_view>

#include "engine/names/enum_names.hpp"

namespace isojam {

/// Result of a fit.
enum class FitVerdict {
  not_called,
  fitted,
  /// A cut-off was found, but it is doubtful, because the fitted function does not describe c. Their largest difference
  /// exceeds Kolmogorov's 5 % limit, for example at a second jump of c.
  bimodal,
  collapsed,  ///< c has no jump: a_0 is less than 2 standard errors above 0, or less than the step of c at one angle
  alpha_out_of_range,  ///< the jump is in the upper half of the window, so no angle is near 0
  too_few              ///< there are fewer angles below `upper` than the five free parameters α, a_0..a_3
};
template <>
inline constexpr std::array enum_names<FitVerdict>{EnumName{FitVerdict::not_called, "not_called"},
                                                   EnumName{FitVerdict::fitted, "fitted"},
                                                   EnumName{FitVerdict::bimodal, "bimodal"},
                                                   EnumName{FitVerdict::collapsed, "collapsed"},
                                                   EnumName{FitVerdict::alpha_out_of_range, "alpha_out_of_range"},
                                                   EnumName{FitVerdict::too_few, "too_few"}};

/// Least-squares fit of the paper's function c_f(θ) = H(θ−α)[a_0 − Σ_{n=1..3} a_n (θ−α)^n] to the empirical cumulative
/// distribution c(θ) of alignment angles on [0, upper]. H is the step function, and `upper` is half of the smallest
/// critical angle.
struct CdfFit {
  FitVerdict verdict = FitVerdict::not_called;  ///< result of the fit
  double alpha = 0;                             ///< parameter α, radians
  double a[4] = {0, 0, 0, 0};                   ///< parameters a_0..a_3, with a_0 ≤ c(upper)
  double a0_error = 0;  ///< standard error of a_0, from the angles above the jump, which are assumed to be independent
  double error = 0;     ///< squared deviation ∫ (c_f − c)² dθ
  /// Largest deviation sup |c_f − c| above the jump, where c ≥ a_0. For n independent angles, random noise causes a
  /// deviation above 1.358/√n from the true distribution in one of twenty sets. It causes such a deviation from a curve
  /// fitted to the angles more rarely.
  double deviation = 0;
  /// Cut-off θ_cut (radians), defined by c(θ_cut) = a_0. c is a step function. The cut-off is therefore the end of the
  /// step whose value is nearest to a_0, and at most `upper`. The fraction of angles below θ_cut is a_0 within half a
  /// step. It is 0 unless the verdict is fitted or bimodal.
  double cutoff = 0;

  /// True if a cut-off was found. It may be doubtful.
  bool has_cutoff() const { return verdict == FitVerdict::fitted || verdict == FitVerdict::bimodal; }
};

/// Finds the global minimum of CdfFit::error over all parameters, with α in [0, upper). c is integrated exactly.
/// `angles` (radians, in any order) must contain the angles of all contacts. Angles above `upper` are needed too,
/// because c is normalised by their number. Throws std::invalid_argument if an angle is negative or not finite, or if
/// `upper` is not positive.
CdfFit fit_cdf(std::span<const double> angles, double upper);

}  // namespace isojam
