#include "engine/solve/minimise/line_search.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

namespace isojam {

namespace {

/// Minimum of the cubic through two points with their slopes. It is kept away from the ends of the interval, so that
/// the interval shrinks.
double cubic_minimum(const LinePoint& p, const LinePoint& q) {
  const double width = q.step - p.step;
  const double d1 = p.slope + q.slope - 3 * (q.value - p.value) / width;
  const double square = d1 * d1 - p.slope * q.slope;
  double t = p.step + width / 2;
  if (square >= 0) {
    const double d2 = std::copysign(std::sqrt(square), width);
    const double candidate = q.step - width * (q.slope + d2 - d1) / (q.slope - p.slope + 2 * d2);
    if (std::isfinite(candidate)) t = candidate;
  }
  const double low = std::min(p.step, q.step), high = std::max(p.step, q.step);
  const double margin = 0.05 * (high - low);
  return std::clamp(t, low + margin, high - margin);
}

class Search {
 public:
  Search(const LinePoint& start, const LineSearchOptions& options)
      : start_(start),
        options_(options),
        noise_(std::max(options.noise, 4 * std::numeric_limits<double>::epsilon() * std::abs(start.value))) {}

  static bool finite(const LinePoint& p) { return std::isfinite(p.value) && std::isfinite(p.slope); }
  bool decreases(const LinePoint& p) const {
    if (!finite(p)) return false;
    if (p.value <= start_.value + options_.decrease * p.step * start_.slope) return true;
    return p.value <= start_.value + noise_ && p.slope <= (2 * options_.decrease - 1) * start_.slope;
  }
  bool flat_enough(const LinePoint& p) const { return std::abs(p.slope) <= -options_.curvature * start_.slope; }
  /// True if p has a lower value than `best`. If the values differ only by rounding errors: true if p has a smaller
  /// slope.
  bool better(const LinePoint& p, const LinePoint& best) const {
    if (std::abs(p.value - best.value) > noise_) return p.value < best.value;
    return std::abs(p.slope) < std::abs(best.slope);
  }
  /// True if the value at p is higher than the value at `best` by more than rounding errors.
  bool higher(const LinePoint& p, const LinePoint& best) const { return p.value > best.value + noise_; }

 private:
  LinePoint start_;
  LineSearchOptions options_;
  double noise_;
};

/// The next trial step: farther than `p` if the minimum is not bracketed, otherwise within the bracket.
double next_step(const LinePoint& p, const LinePoint& low, const LinePoint& high, bool bracketed, double longest) {
  if (!bracketed) return std::min({3 * p.step, longest});
  return std::isfinite(high.value) ? cubic_minimum(low, high) : (low.step + high.step) / 2;
}

}  // namespace

LineSearchResult line_search(const std::function<LinePoint(double)>& at, const LinePoint& start, double first_step,
                             const LineSearchOptions& options) {
  assert(start.slope < 0 && first_step > 0);
  const Search search(start, options);
  LineSearchResult result;
  result.point = start;
  // `low` is the best point with sufficient decrease. Once bracketed, the minimum lies between it and `high`.
  LinePoint low = start, high;
  bool bracketed = false;
  double step = std::min(first_step, options.longest_step);
  while (result.evaluations < options.max_evaluations) {
    const LinePoint p = at(step);
    ++result.evaluations;
    if (search.decreases(p)) {
      if (search.better(p, result.point)) result.point = p;
      if (search.flat_enough(p)) {
        result.point = p;
        result.found = true;
        return result;
      }
    }
    if (!search.decreases(p) || search.higher(p, low)) {
      high = p;
      bracketed = true;
      if (!Search::finite(p)) {
        step = low.step + (p.step - low.step) / 4;
        high.value = std::numeric_limits<double>::infinity();
        high.slope = 1;
        continue;
      }
    } else {
      if (p.slope * ((bracketed ? high.step : std::numeric_limits<double>::infinity()) - p.step) >= 0) {
        high = low;
        bracketed = true;
      }
      low = p;
      if (!bracketed && p.step >= options.longest_step) {
        result.found = true;  // still descending at the longest step allowed
        result.point = p;
        return result;
      }
    }
    step = next_step(p, low, high, bracketed, options.longest_step);
    if (step == low.step || (bracketed && step == high.step)) break;
  }
  result.found = result.point.step > 0;
  return result;
}

}  // namespace isojam
