#pragma once

// These functions are computed in software in quadruple precision, like those of elementary.hpp. They therefore give
// the same bits on every processor.

namespace isojam {

/// The quantile t with P(|T| ≤ t) = share, for 0 < share < 1. T has Student's distribution with ν = `degrees` ≥ 1
/// degrees of freedom. P is computed from the finite series in cos² θ with θ = atan(t/√ν) (Abramowitz & Stegun 26.7.3
/// and 26.7.4). This takes a few milliseconds for 100 000 degrees of freedom.
double student_two_sided(double share, long degrees);

/// The quantile x with P(X ≤ x) = share, for 0 < share < 1. X is normal with mean 0 and variance 1.
double normal_quantile(double share);

/// Probabilities of the two tails of a binomial distribution: X is the number of successes.
struct BinomialTails {
  double at_most = 0;   ///< P(X ≤ k)
  double at_least = 0;  ///< P(X ≥ k)
};
/// Probabilities of at most k and of at least k successes in n trials with success probability p. Requires 0 ≤ k ≤ n
/// and 0 ≤ p ≤ 1.
BinomialTails binomial_tails(long n, double p, long k);

}  // namespace isojam
