#include "engine/analysis/alignment/cdf_fit.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

// Method. Let y = (upper − θ)/(upper − α), which decreases from 1 at α to 0 at upper. The cubic is written in the
// Legendre polynomials P_j shifted to [0, 1], ∫ P_i P_j dy = δ_ij/(2j + 1). The least-squares coefficients are then β_j
// = (2j + 1) ∫ c P_j dy. Because c is a step function, β_j are sums over the angles of antiderivatives of P_j, which
// are polynomials in y of degree 4 or less. They are computed for every α from the same sums of powers of upper − θ.
// All terms of these sums are positive. E(α) is the error of the best cubic. Its slope is dE/dα = c² − (a_0 − c)² = a_0
// (2c − a_0), because only the lower limit of the integral depends on α. The space of cubics does not depend on α.

namespace isojam {

namespace {

using Vector4d = Eigen::Vector4d;

constexpr int free_parameters = 5;  // α and a_0..a_3

/// The empirical distribution c of all angles, on [0, upper].
class Window {
 public:
  Window(std::span<const double> angles, double upper) : total_(static_cast<double>(angles.size())), upper_(upper) {
    sorted_.assign(angles.begin(), angles.end());
    std::sort(sorted_.begin(), sorted_.end());
    inside_ = std::lower_bound(sorted_.begin(), sorted_.end(), upper) - sorted_.begin();
    power_sums_.assign(inside_ + 1, Powers{});
    for (long k = inside_ - 1; k >= 0; --k) {
      double power = 1;
      for (int j = 0; j < 5; ++j) {
        power_sums_[k][j] = power_sums_[k + 1][j] + power;
        power *= upper - sorted_[k];
      }
    }
  }

  long inside() const { return inside_; }  ///< number of angles below `upper`
  double upper() const { return upper_; }
  double angle(long k) const { return sorted_[k]; }  ///< ascending, from index 0
  double height(long count) const { return static_cast<double>(count) / total_; }

  /// Number of angles below `upper` that are at most α.
  long count_at(double alpha) const {
    return std::upper_bound(sorted_.begin(), sorted_.begin() + inside_, alpha) - sorted_.begin();
  }

  /// End of the step of c whose height is nearest to `height`. It is at most `upper`.
  double end_of_step(double height) const {
    double end = 0, nearest = height;  // the step of height 0 ends at the first angle
    for (long k = 0; k <= inside_;) {
      const double next = k < inside_ ? sorted_[k] : upper_;
      const double distance = std::abs(this->height(k) - height);
      if (k == 0 || distance < nearest) {
        nearest = distance;
        end = next;
      }
      k = k < inside_ ? count_at(next) : inside_ + 1;
    }
    return end;
  }

  /// Coefficients β of the cubic on [α, upper] that fits c best.
  Vector4d legendre_coefficients(double alpha) const {
    const long below = count_at(alpha);
    const double width = upper_ - alpha;
    double s[5], scale = 1;
    for (int j = 0; j < 5; ++j) {
      s[j] = power_sums_[below][j] / (scale * total_);
      scale *= width;
    }
    return {height(below) + s[1], 3 * (s[2] - s[1]), 5 * (2 * s[3] - 3 * s[2] + s[1]),
            7 * (5 * s[4] - 10 * s[3] + 6 * s[2] - s[1])};
  }

 private:
  using Powers = std::array<double, 5>;  ///< Σ (upper − θ_k)^j for j = 0 to 4
  double total_, upper_;
  long inside_ = 0;
  std::vector<double> sorted_;
  std::vector<Powers> power_sums_;  ///< element k: sums over the angles k, k + 1, ... below `upper`
};

/// ∫_0^upper c² dθ − E(α): the part of c² that the best cubic on [α, upper] explains.
double explained(const Window& window, double alpha) {
  const Vector4d beta = window.legendre_coefficients(alpha);
  return (window.upper() - alpha) * beta.cwiseAbs2().dot(Vector4d(1, 1. / 3, 1. / 5, 1. / 7));
}

/// A number with the sign of dE/dα at α, where c has the height of `count` angles.
double error_slope(const Window& window, double alpha, long count) {
  const double a0 = window.legendre_coefficients(alpha).sum();
  return a0 * (2 * window.height(count) - a0);
}

/// The point between `low` and `high` where E stops decreasing. No angle may lie between `low` and `high`.
double descend(const Window& window, double low, double high, long count) {
  while (true) {
    const double middle = low + (high - low) / 2;
    if (middle <= low || middle >= high) return low;
    (error_slope(window, middle, count) < 0 ? low : high) = middle;
  }
}

/// The α with the smallest E. E is continuous, and smooth between angles. Its minimum is therefore at an angle, or
/// where its slope changes sign.
double best_alpha(const Window& window) {
  constexpr int subdivisions = 64;  // resolves wide gaps, where E may have several minima
  std::vector<double> points;
  for (int i = 0; i < subdivisions; ++i) points.push_back(window.upper() * i / subdivisions);
  for (long k = 0; k < window.inside(); ++k) points.push_back(window.angle(k));
  std::sort(points.begin(), points.end());
  points.erase(std::unique(points.begin(), points.end()), points.end());

  double best = points.front(), most = explained(window, best);
  const auto consider = [&](double alpha) {
    const double value = explained(window, alpha);
    if (value > most) {
      most = value;
      best = alpha;
    }
  };
  for (std::size_t k = 0; k < points.size(); ++k) {
    consider(points[k]);
    const double next = k + 1 < points.size() ? points[k + 1] : std::nextafter(window.upper(), 0.0);
    const long count = window.count_at(points[k]);
    const double before_next = std::nextafter(next, 0.0);
    if (before_next <= points[k]) continue;
    if (error_slope(window, points[k], count) < 0 && error_slope(window, before_next, count) > 0) {
      consider(descend(window, points[k], before_next, count));
    }
  }
  return best;
}

/// Standard error of a_0. The fit gives a_0 = Σ β_j = c(α) + (1/n) Σ K(y_k), with the sum over the angles above α. The
/// angles of the jump, up to c = a_0, have K ≈ 1. They contribute as if they were below α, and cause no noise. If all
/// other angles are independent, the variance of their sum is Σ K²/n². Because K ≤ 1, a_0 never exceeds c(upper).
double standard_error(const Window& window, const CdfFit& fit) {
  double sum = 0;
  for (long k = window.count_at(fit.alpha); k < window.inside(); ++k) {
    if (window.height(k + 1) <= fit.a[0]) continue;
    const double y = (window.upper() - window.angle(k)) / (window.upper() - fit.alpha);
    const double influence = y * (-4 + y * (30 + y * (-60 + y * 35)));
    sum += influence * influence;
  }
  return std::sqrt(sum) * window.height(1);
}

/// ∫ (c_f − c)² dθ over an interval in which c is constant. The integrand is a polynomial of degree 6, so four Gauss
/// points are exact. Compared with ∫ c² − explained(), it is not a difference of large numbers.
double stretch_error(const CdfFit& fit, double from, double to, double height) {
  static constexpr double node[2] = {0.33998104358485626, 0.86113631159405258};
  static constexpr double weight[2] = {0.65214515486254614, 0.34785484513745386};
  const double centre = (from + to) / 2, half = (to - from) / 2;
  double sum = 0;
  for (int i = 0; i < 2; ++i) {
    for (const double side : {-1.0, 1.0}) {
      const double x = centre + side * half * node[i] - fit.alpha;
      const double deviation = fit.a[0] - x * (fit.a[1] + x * (fit.a[2] + x * fit.a[3])) - height;
      sum += weight[i] * deviation * deviation;
    }
  }
  return sum * half;
}

double fit_error(const CdfFit& fit, const Window& window) {
  double error = 0, from = 0;
  for (long k = 0; k <= window.inside(); ++k) {
    const double to = k < window.inside() ? window.angle(k) : window.upper();
    const double height = window.height(k);
    const double split = std::clamp(fit.alpha, from, to);
    error += height * height * (split - from) + stretch_error(fit, split, to, height);
    from = to;
  }
  return error;
}

/// The largest deviation above the jump. The curve may deviate on both sides of a step, and a cubic has at most two
/// extremes between two angles. 16 points per interval are enough to find deviations that are larger than the noise of
/// a step.
double largest_deviation(const CdfFit& fit, const Window& window) {
  double largest = 0, from = std::max(fit.alpha, window.end_of_step(fit.a[0]));
  for (long k = window.count_at(from); k <= window.inside(); ++k) {
    const double to = k < window.inside() ? window.angle(k) : window.upper();
    for (int i = 0; i <= 16; ++i) {
      const double x = from + (to - from) * i / 16 - fit.alpha;
      const double value = fit.a[0] - x * (fit.a[1] + x * (fit.a[2] + x * fit.a[3]));
      largest = std::max(largest, std::abs(value - window.height(k)));
    }
    from = to;
  }
  return largest;
}

FitVerdict judge(const CdfFit& fit, const Window& window) {
  constexpr double kolmogorov = 1.358;  // 5 % of sup |F_n − F| √n exceed this
  // A fit to a CDF without a jump finds a jump of the size of the noise.
  if (fit.a[0] < std::max(window.height(1), 2 * fit.a0_error)) return FitVerdict::collapsed;
  if (fit.alpha >= window.upper() / 2) return FitVerdict::alpha_out_of_range;
  if (fit.deviation > kolmogorov * std::sqrt(window.height(1))) return FitVerdict::bimodal;
  return FitVerdict::fitted;
}

}  // namespace

CdfFit fit_cdf(std::span<const double> angles, double upper) {
  if (!(upper > 0) || !std::isfinite(upper)) throw std::invalid_argument("the window of a CDF fit must be positive");
  for (const double angle : angles) {
    if (!(angle >= 0) || !std::isfinite(angle)) throw std::invalid_argument("angles of a CDF must be 0 or more");
  }
  const Window window(angles, upper);
  CdfFit fit;
  if (window.inside() < free_parameters) {
    fit.verdict = FitVerdict::too_few;
    return fit;
  }
  fit.alpha = best_alpha(window);
  const Vector4d beta = window.legendre_coefficients(fit.alpha);
  const double width = upper - fit.alpha;
  fit.a[0] = beta.sum();
  fit.a[1] = (2 * beta[1] + 6 * beta[2] + 12 * beta[3]) / width;
  fit.a[2] = -(6 * beta[2] + 30 * beta[3]) / (width * width);
  fit.a[3] = 20 * beta[3] / (width * width * width);
  fit.a0_error = standard_error(window, fit);
  fit.error = fit_error(fit, window);

  fit.deviation = largest_deviation(fit, window);
  fit.verdict = judge(fit, window);
  if (fit.has_cutoff()) fit.cutoff = window.end_of_step(fit.a[0]);
  return fit;
}

}  // namespace isojam
