#include "engine/analysis/alignment/trough.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <vector>

#include "engine/analysis/alignment/angle_histogram.hpp"
#include "engine/arithmetic/elementary.hpp"

namespace isojam {

namespace {

constexpr double bin_width = 1.0 / angle_bins_per_decade;
constexpr double misjudged = 0.05;  // probability of a trough in a density without one

/// Numbers of angles below the edges of bins. Element k is the number in the first k bins.
std::vector<double> cumulative(std::span<const double> counts) {
  std::vector<double> sums{0};
  for (const double count : counts) {
    if (!(count >= 0) || !std::isfinite(count)) throw std::invalid_argument("numbers of angles must be 0 or more");
    sums.push_back(sums.back() + count);
  }
  return sums;
}

/// Positions of the vertices of the greatest convex minorant of `sums` on [from, to].
std::vector<int> minorant_vertices(const std::vector<double>& sums, int from, int to) {
  std::vector<int> hull;
  const auto slope = [&](int a, int b) { return (sums[b] - sums[a]) / (b - a); };
  for (int k = from; k <= to; ++k) {
    while (hull.size() > 1 && slope(hull[hull.size() - 2], hull.back()) >= slope(hull[hull.size() - 2], k))
      hull.pop_back();
    hull.push_back(k);
  }
  return hull;
}

/// A segment of the minorant, and the place of its largest excess.
struct Segment {
  int end = 0, highest = 0;
  double excess = 0, angles = 0;
  double significance() const { return angles > 0 ? excess / std::sqrt(angles) : 0; }
};

/// The segment with the largest E/√n.
Segment best_segment(const std::vector<double>& sums, const std::vector<int>& vertices) {
  Segment best;
  for (std::size_t i = 1; i < vertices.size(); ++i) {
    const int a = vertices[i - 1], b = vertices[i];
    Segment segment{.end = b, .highest = a, .excess = 0, .angles = sums[b] - sums[a]};
    for (int k = a + 1; k < b; ++k) {
      const double excess = sums[k] - sums[a] - segment.angles * (k - a) / (b - a);
      if (excess > segment.excess) {
        segment.excess = excess;
        segment.highest = k;
      }
    }
    if (segment.significance() > best.significance()) best = segment;
  }
  return best;
}

/// The smallest t for which m·2 (4t² − 1) exp(−2t²) is at most `misjudged`. The expression decreases for t > √3/2,
/// because m, the number of segments with more than t² angles, does not increase.
double critical_significance(const std::vector<double>& sums, const std::vector<int>& vertices) {
  double low = std::numbers::sqrt3 / 2, high = 10;
  for (int halvings = 0; halvings < 50; ++halvings) {
    const double t = (low + high) / 2;
    int segments = 0;
    for (std::size_t i = 1; i < vertices.size(); ++i) segments += sums[vertices[i]] - sums[vertices[i - 1]] > t * t;
    (segments * 2 * (4 * t * t - 1) * nearest::exp(-2 * t * t) > misjudged ? low : high) = t;
  }
  return high;
}

/// Position below which a fraction of the angles in the bins [from, to) is.
double quantile(const std::vector<double>& sums, int from, int to, double fraction) {
  const double wanted = sums[from] + fraction * (sums[to] - sums[from]);
  int k = from + 1;
  while (k < to && sums[k] < wanted) ++k;
  const double inside = sums[k] - sums[k - 1];
  return k - 1 + (inside > 0 ? (wanted - sums[k - 1]) / inside : 0);
}

/// Silverman's rule for the angles in the bins [from, to), in bins.
double silverman(const std::vector<double>& sums, int from, int to) {
  const double n = sums[to] - sums[from];
  double mean = 0, variance = 0;
  for (int k = from; k < to; ++k) mean += (sums[k + 1] - sums[k]) / n * k;
  for (int k = from; k < to; ++k) variance += (sums[k + 1] - sums[k]) / n * squared(k - mean);
  const double range = quantile(sums, from, to, 0.75) - quantile(sums, from, to, 0.25);
  return 0.9 * std::min(std::sqrt(variance), range / 1.34) * nearest::pow(n, -0.2);
}

/// Numbers of angles within the kernel at each position: the sum of exp(−d²/2) over all angles, where d is the distance
/// from the position in units of the kernel. The density is this number divided by √(2π) times the kernel.
std::vector<double> smoothed(std::span<const double> counts, double kernel) {
  const int bins = static_cast<int>(counts.size());
  std::vector<double> weights;  // element k: weight at the distance k + 1/2
  for (int k = 0; k < bins; ++k) weights.push_back(nearest::exp(-squared((k + 0.5) / kernel) / 2));
  std::vector<double> numbers(counts.size() + 1);
  for (int k = 0; k < bins; ++k) {
    if (counts[k] == 0) continue;
    for (int position = 0; position <= bins; ++position)
      numbers[position] += counts[k] * weights[position > k ? position - k - 1 : k - position];
  }
  return numbers;
}

/// Position of the smallest number in (from, to]. If several are equal, the one in the middle of the first of them.
int lowest_position(const std::vector<double>& numbers, int from, int to) {
  const auto first = std::min_element(numbers.begin() + from + 1, numbers.begin() + to + 1);
  const auto last = std::find_if(first, numbers.begin() + to + 1, [&](double n) { return n != *first; });
  return static_cast<int>(first - numbers.begin() + (last - first - 1) / 2);
}

/// Sets the position, the edges and the depth of the trough. The verdict stays undecided if the smoothed density has no
/// minimum in (from, to].
void locate(Trough& trough, const std::vector<double>& numbers, int from, int to, int window) {
  const int at = lowest_position(numbers, from, to);
  const double least = numbers[at];
  const double below = *std::max_element(numbers.begin(), numbers.begin() + at + 1);
  const double above = *std::max_element(numbers.begin() + at, numbers.end());
  const double peak = std::min(below, above);
  if (!(least < peak)) return;
  trough.verdict = TroughVerdict::found;
  trough.cutoff = trough.low = trough.high = at;
  const double level = std::max(std::sqrt(5.0) / 2 * least, least + 1 + std::sqrt(least + 0.75));
  while (trough.low > 0 && numbers[trough.low - 1] <= level) --trough.low;
  while (trough.high < window && numbers[trough.high + 1] <= level) ++trough.high;
  trough.density = least / (std::sqrt(2 * std::numbers::pi) * trough.kernel);
  trough.depth = 1 - least / peak;
}

}  // namespace

Trough find_trough(std::span<const double> counts, int window) {
  if (window < 0 || window > static_cast<int>(counts.size()))
    throw std::invalid_argument("the window of a trough must be a number of bins");
  const std::vector<double> sums = cumulative(counts);
  Trough trough{.verdict = TroughVerdict::undecided};
  const auto occupied = std::find_if(counts.begin(), counts.end(), [](double count) { return count > 0; });
  const int first = static_cast<int>(occupied - counts.begin());
  if (first >= window) return trough;
  const std::vector<int> vertices = minorant_vertices(sums, first, window);
  const Segment segment = best_segment(sums, vertices);
  const int bins = static_cast<int>(counts.size());
  trough.excess = segment.excess;
  trough.critical = critical_significance(sums, vertices) * std::sqrt(segment.angles);
  if (!(segment.excess > trough.critical) || !(sums[bins] > sums[segment.highest])) return trough;
  const double kernel =
      std::max({1.0, silverman(sums, first, segment.highest), silverman(sums, segment.highest, bins)});
  trough.kernel = kernel * bin_width;
  locate(trough, smoothed(counts, kernel), segment.highest, segment.end, window);
  return trough;
}

}  // namespace isojam
