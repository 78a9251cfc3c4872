#pragma once

#include <array>
#include <span>
#include <string_view>

#include "engine/names/enum_names.hpp"

namespace isojam {

/// What came of a fit.
enum class FitVerdict {
  not_called,
  fitted,
  /// The basis does not describe c: they differ by more than Kolmogorov's 5 % bound somewhere, as where there is a
  /// second jump. The cut-off is given, but not to be trusted.
  bimodal,
  collapsed,           ///< c shows no jump: a_0 is within 2 standard errors of 0, or worth less than one angle
  alpha_out_of_range,  ///< the jump is in the upper half of the window: nothing is near alignment
  too_few              ///< fewer angles below `upper` than the five free parameters α, a_0..a_3
};
template <>
inline constexpr std::array enum_names<FitVerdict>{EnumName{FitVerdict::not_called, "not_called"},
                                                   EnumName{FitVerdict::fitted, "fitted"},
                                                   EnumName{FitVerdict::bimodal, "bimodal"},
                                                   EnumName{FitVerdict::collapsed, "collapsed"},
                                                   EnumName{FitVerdict::alpha_out_of_range, "alpha_out_of_range"},
                                                   EnumName{FitVerdict::too_few, "too_few"}};

/// Least-squares fit of the paper's basis c_f(θ) = H(θ−α)[a_0 − Σ_{n=1..3} a_n (θ−α)^n] to an empirical CDF on
/// [0, upper], upper half the least critical angle.
struct CdfFit {
  FitVerdict verdict = FitVerdict::not_called;  ///< whether there is a cut-off, and why not
  double alpha = 0;                             ///< radians
  double a[4] = {0, 0, 0, 0};                   ///< a_0 ≤ c(upper)
  double a0_error = 0;  ///< standard error of a_0 from the angles above the jump, taken as independent
  double error = 0;     ///< ∫ (c_f − c)² dθ
  /// Largest deviation sup |c_f − c| beyond the jump, where c ≥ a_0. Noise of n independent angles exceeds 1.358/√n in
  /// one set of twenty, more rarely about a curve fitted to them.
  double deviation = 0;
  /// Cut-off θ_cut (radians): c = a_0. As c has steps, the end of the step nearest to a_0, at most `upper`: the
  /// fraction of angles below θ_cut is a_0 to within half a step. 0 unless fitted or bimodal.
  double cutoff = 0;

  /// Whether the fit gives a cut-off, be it one not to be trusted.
  bool has_cutoff() const { return verdict == FitVerdict::fitted || verdict == FitVerdict::bimodal; }
};

/// Finds the global minimum of the error, over α in [0, upper) too; c is integrated exactly.
/// `angles` in any order, radians, all contacts (also those above `upper`: the CDF counts them).
/// Throws std::invalid_argument if an angle is negative or not finite, or `upper` is not positive.
CdfFit fit_cdf(std::span<const double> angles, double upper);

}  // namespace isojam
