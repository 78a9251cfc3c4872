#pragma once

#include <span>
#include <vector>

namespace isojam {

enum class FitVerdict { not_called, fitted, collapsed, too_few };

/// Least-squares fit of c_f(θ) = H(θ−α)[a_0 − Σ_{n=1..3} a_n (θ−α)^n] to an empirical CDF on [0, upper].
struct CdfFit {
  FitVerdict verdict = FitVerdict::not_called;
  double alpha = 0;       ///< radians
  double a[4] = {0, 0, 0, 0};
  double error = 0;       ///< ∫ (c_f − c)² dθ
  double cutoff = 0;      ///< θ_cut: c(θ_cut) = a_0
};

/// `angles` in any order, radians, all contacts (also those above `upper`: the CDF counts them).
CdfFit fit_cdf(std::span<const double> angles, double upper);

}  // namespace isojam
