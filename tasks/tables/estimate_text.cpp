#include "tasks/tables/estimate_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>

#include "engine/arithmetic/elementary.hpp"

namespace isojam {
namespace {

/// Largest number of significant digits of a mean. The last bits of a mean are no result, even if the values of all
/// replicates agree in them: residuals are 1e-6 by default.
constexpr int most_digits = 6;

std::string_view plus_minus(Format format) { return format == Format::text ? " ± " : " $\\pm$ "; }

/// True if there is only one value, or if all values are equal within rounding errors.
bool without_spread(const Estimate& estimate) {
  return estimate.half_width.value_or(0) <= 1e-14 * std::abs(*estimate.mean);
}

/// True if most decimals of the value would be zeros.
bool small(const Estimate& estimate) {
  return *estimate.mean != 0 && std::abs(*estimate.mean) < 1e-3 && estimate.half_width.value_or(0) < 1e-2;
}

/// Place of the first significant digit: 0 for 1 … 9.99, −1 for 0.1 … 0.99.
int magnitude(double x) { return static_cast<int>(std::floor(nearest::log10(x))); }

/// Text of an estimate without spread. An integer is a count and has no decimals.
std::string text_without_spread(const Estimate& estimate) {
  const double mean = *estimate.mean;
  if (mean == std::round(mean)) return fmt::format("{:.0f}", mean);
  const auto text = small(estimate) ? fmt::format("{:.2e}", mean) : fmt::format("{:.4f}", mean);
  return estimate.half_width ? text + " (equal)" : text;
}

/// Text with one power of ten for the mean and the half width. The half width is at least one unit of the last digit.
std::string small_text(const Estimate& estimate, Format format) {
  const int power = magnitude(std::max(std::abs(*estimate.mean), *estimate.half_width));
  const double unit = nearest::pow(10.0, power);
  return fmt::format("({:.2f}{}{:.2f})e{:+03d}", *estimate.mean / unit, plus_minus(format),
                     std::max(*estimate.half_width / unit, 0.01), power);
}

/// Text with as many decimals as are needed to show two significant digits of the half width, or `most_digits` of the
/// mean. The half width is at least one unit of the last decimal.
std::string text_with_spread(const Estimate& estimate, Format format) {
  const double half = *estimate.half_width;
  const int largest = most_digits - 1 - magnitude(std::max(std::abs(*estimate.mean), half));
  const int decimals = std::clamp(std::min(1 - magnitude(half), largest), 0, 12);
  return fmt::format("{:.{}f}{}{:.{}f}", *estimate.mean, decimals, plus_minus(format),
                     std::max(half, nearest::pow(10.0, -decimals)), decimals);
}

/// The ends of Wilson's interval are at different distances from the proportion.
std::string proportion_text(const Estimate& estimate) {
  if (!estimate.ci95) return text_without_spread(estimate);
  const int decimals = std::clamp(1 - magnitude(*estimate.half_width), 2, 12);
  return fmt::format("{:.{}f} [{:.{}f}, {:.{}f}]", *estimate.mean, decimals, estimate.ci95->low, decimals,
                     estimate.ci95->high, decimals);
}

}  // namespace

std::string estimate_text(const Estimate& estimate, Format format, int expected) {
  if (!estimate.mean) return "-";
  auto text = estimate.method == IntervalMethod::wilson ? proportion_text(estimate)
              : without_spread(estimate)                ? text_without_spread(estimate)
              : small(estimate)                         ? small_text(estimate, format)
                                                        : text_with_spread(estimate, format);
  if (estimate.n < expected) text += fmt::format(" ({})", estimate.n);
  return text;
}

}  // namespace isojam
