#pragma once

// Computed in software quadruple precision, as in elementary.hpp, and hence with the same bits on every processor.

namespace isojam {

/// t with P(|T| ≤ t) = share for Student's T with `degrees` ≥ 1 degrees of freedom; 0 < share < 1. Uses the finite
/// series in cos² of atan(t/√ν) (Abramowitz & Stegun 26.7.3 and 26.7.4); takes a few milliseconds for 100 000 degrees.
double student_two_sided(double share, long degrees);

/// x with P(X ≤ x) = share for a normal X of mean 0 and variance 1; 0 < share < 1.
double normal_quantile(double share);

/// Both tails of a binomial distribution.
struct BinomialTails {
  double at_most = 0;   ///< P(X ≤ k)
  double at_least = 0;  ///< P(X ≥ k)
};
/// Probabilities of at most and of at least k successes in n trials with success probability p, 0 ≤ k ≤ n, 0 ≤ p ≤ 1.
BinomialTails binomial_tails(long n, double p, long k);

}  // namespace isojam
