#include "engine/arithmetic/distributions.hpp"

#include <cassert>

#include "engine/arithmetic/quad_functions.hpp"

namespace isojam {

namespace {

const Quad half_pi = 2 * QUAD(atan)(1);

/// Root of a function that increases with x > 0, by bisection down to adjacent doubles. `above` is a first guess of a
/// value above the root. The result has the same bits on every processor.
template <class Ascending>
double root_of(const Ascending& f, double above) {
  double low = 0, high = above;
  while (f(high) < 0) high *= 2;
  for (;;) {
    const double middle = low + (high - low) / 2;
    if (!(middle > low && middle < high)) return high;
    (f(middle) < 0 ? low : high) = middle;
  }
}

/// P(|T| ≤ t).
Quad student_share(Quad t, long degrees) {
  const Quad ratio = t / QUAD(sqrt)(degrees), cos2 = 1 / (1 + ratio * ratio), cosine = QUAD(sqrt)(cos2),
             sine = ratio * cosine;
  const bool odd = degrees % 2 == 1;
  Quad term = odd ? cosine : 1, sum = degrees == 1 ? Quad(0) : term;
  for (long k = odd ? 3 : 2; k < degrees; k += 2) {
    term *= cos2 * (k - 1) / k;
    sum += term;
    if (term < sum * 1e-34) break;
  }
  return odd ? (QUAD(atan)(ratio) + sine * sum) / half_pi : sine * sum;
}

/// Sum of the terms `from` … `last` of a series. `first` is the term `from`, and next(j) is the ratio of the term after
/// term j to term j. The sum ends early if a term is negligible.
template <class Next>
Quad series(Quad first, long from, long last, int step, const Next& next) {
  Quad sum = first, term = first;
  for (long j = from; j != last; j += step) {
    term *= next(j);
    sum += term;
    if (term < sum * 1e-36) break;
  }
  return sum;
}

}  // namespace

double student_two_sided(double share, long degrees) {
  assert(share > 0 && share < 1 && degrees >= 1);
  return root_of([&](double t) { return student_share(t, degrees) - share; }, 1);
}

double normal_quantile(double share) {
  assert(share > 0 && share < 1);
  if (share == 0.5) return 0;
  const Quad tail = share < 0.5 ? Quad(share) : 1 - Quad(share);
  const double x = root_of([&](double z) { return tail - QUAD(erfc)(z / QUAD(sqrt)(2)) / 2; }, 1);
  return share < 0.5 ? -x : x;
}

BinomialTails binomial_tails(long n, double p, long k) {
  assert(0 <= k && k <= n && p >= 0 && p <= 1);
  if (p == 0) return {1, k == 0 ? 1.0 : 0.0};
  if (p == 1) return {k == n ? 1.0 : 0.0, 1};
  const Quad q = 1 - Quad(p), odds = p / q;
  const Quad here = QUAD(exp)(QUAD(lgamma)(n + 1) - QUAD(lgamma)(k + 1) - QUAD(lgamma)(n - k + 1) + k * QUAD(log)(p) +
                              (n - k) * QUAD(log)(q));
  // Sums the tail whose terms decrease from k on. This tail may be far smaller than the rounding error of the other
  // one.
  if (static_cast<double>(k) >= static_cast<double>(n) * p) {
    const Quad at_least = series(here, k, n, 1, [&](long j) { return (n - j) * odds / (j + 1); });
    return {static_cast<double>(1 - at_least + here), static_cast<double>(at_least)};
  }
  const Quad at_most = series(here, k, 0, -1, [&](long j) { return Quad(j) / (n - j + 1) / odds; });
  return {static_cast<double>(at_most), static_cast<double>(1 - at_most + here)};
}

}  // namespace isojam
