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
  /// The basis does not describe c: somewhere they differ by more than Kolmogorov's 5 % limit, for example at a second
  /// jump. The cut-off is set, but is doubtful.
  bimodal,
  collapsed,           ///< c has no jump: a_0 is within 2 standard errors of 0, or less than one angle's step
  alpha_out_of_range,  ///< the jump is in the upper half of the window: no angle is near alignment
  too_few              ///< fewer angles below `upper` than the five free parameters α, a_0..a_3
};
template <>
inline constexpr std::array enum_names<FitVerdict>{EnumName{FitVerdict::not_called, "not_called"},
                                                   EnumName{FitVerdict::fitted, "fitted"},
                                                   EnumName{FitVerdict::bimodal, "bimodal"},
                                                   EnumName{FitVerdict::collapsed, "collapsed"},
                                                   EnumName{FitVerdict::alpha_out_of_range, "alpha_out_of_range"},
                                                   EnumName{FitVerdict::too_few, "too_few"}};

/// Least-squares fit of the paper's basis c_f(θ) = H(θ−α)[a_0 − Σ_{n=1..3} a_n (θ−α)^n] to an empirical CDF on [0,
/// upper]; `upper` is half the smallest critical angle.
struct CdfFit {
  FitVerdict verdict = FitVerdict::not_called;  ///< result
  double alpha = 0;                             ///< radians
  double a[4] = {0, 0, 0, 0};                   ///< a_0 ≤ c(upper)
  double a0_error = 0;  ///< standard error of a_0 from the angles above the jump, assumed independent
  double error = 0;     ///< ∫ (c_f − c)² dθ
  /// Largest deviation sup |c_f − c| beyond the jump, where c ≥ a_0. Noise of n independent angles exceeds 1.358/√n in
  /// one of twenty sets, and more rarely relative to a curve fitted to them.
  double deviation = 0;
  /// Cut-off θ_cut (radians): c(θ_cut) = a_0. Since c has steps, it is the end of the step nearest to a_0, at most
  /// `upper`; the fraction of angles below θ_cut is a_0 within half a step. 0 unless the verdict is fitted or bimodal.
  double cutoff = 0;

  /// True if a cut-off was found, including doubtful ones.
  bool has_cutoff() const { return verdict == FitVerdict::fitted || verdict == FitVerdict::bimodal; }
};

/// Finds the global minimum of the error, including α in [0, upper); c is integrated exactly. `angles` may have any
/// order, in radians, and must include all contacts (also those above `upper`, which count in the CDF). Throws
/// std::invalid_argument if an angle is negative or not finite, or `upper` is not positive.
CdfFit fit_cdf(std::span<const double> angles, double upper);

}  // namespace isojam
