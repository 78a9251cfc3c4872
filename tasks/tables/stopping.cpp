#include "tasks/tables/stopping.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "tasks/measure/quantity.hpp"
#include "tasks/tables/statistics.hpp"

namespace isojam {
namespace {

std::vector<double> known_in(std::span<const std::optional<double>> values) {
  std::vector<double> known;
  for (const auto& value : values) {
    if (value) known.push_back(*value);
  }
  return known;
}

bool all_equal(const std::vector<double>& values) {
  return std::all_of(values.begin(), values.end(), [&](double x) { return x == values.front(); });
}

/// Computes the confidence interval of all values that are known at a check. `scale` is kept between checks, because
/// Student's t takes long to compute.
void check(Advance& advance, std::optional<double>& scale, const Goal& goal, std::vector<double> known) {
  const auto n = known.size();
  if (quantity(goal.quantity).proportion) {
    advance.half_width = proportion_estimate(std::move(known)).half_width;
  } else {
    if (all_equal(advance.first)) {
      advance.first = std::move(known);
      scale = stein_scale(advance.first);
    }
    if (scale) advance.half_width = *scale / std::sqrt(static_cast<double>(n));
  }
  advance.met = advance.half_width && *advance.half_width > 0 && *advance.half_width <= goal.half_width;
}

}  // namespace

int next_batch_end(int replicates, int max) { return std::min(max, replicates + std::max(2, replicates / 4)); }

Advance advance_of(const Replicates& replicates, std::span<const std::optional<double>> values) {
  Advance advance;
  std::optional<double> scale;
  for (advance.wanted = replicates.min; static_cast<int>(values.size()) >= advance.wanted;
       advance.wanted = next_batch_end(advance.wanted, replicates.max)) {
    auto known = known_in(values.first(static_cast<std::size_t>(advance.wanted)));
    const bool hopeless = replicates.goal && advance.wanted == replicates.min && known.empty();
    if (replicates.goal) check(advance, scale, *replicates.goal, std::move(known));
    if (advance.met || hopeless || advance.wanted == replicates.max) {
      advance.finished = true;
      break;
    }
  }
  return advance;
}

}  // namespace isojam
