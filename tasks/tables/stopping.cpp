#include "tasks/tables/stopping.hpp"

#include <algorithm>
#include <vector>

#include "tasks/tables/statistics.hpp"

namespace isojam {
namespace {

std::optional<double> half_width_of(std::span<const std::optional<double>> values) {
  std::vector<double> known;
  for (const auto& value : values) {
    if (value) known.push_back(*value);
  }
  return student_half_width(known);
}

bool none_known(std::span<const std::optional<double>> values) {
  return std::none_of(values.begin(), values.end(), [](const auto& value) { return value.has_value(); });
}

}  // namespace

int next_batch_end(int replicates, int max) { return std::min(max, replicates + std::max(2, replicates / 4)); }

Advance advance_of(const Replicates& replicates, std::span<const std::optional<double>> values) {
  Advance advance;
  for (advance.wanted = replicates.min; static_cast<int>(values.size()) >= advance.wanted;
       advance.wanted = next_batch_end(advance.wanted, replicates.max)) {
    if (replicates.goal) {
      advance.half_width = half_width_of(values.first(static_cast<std::size_t>(advance.wanted)));
      advance.met = advance.half_width && *advance.half_width <= replicates.goal->half_width;
    }
    const bool hopeless = replicates.goal && none_known(values.first(static_cast<std::size_t>(replicates.min)));
    if (advance.met || hopeless || advance.wanted == replicates.max) {
      advance.finished = true;
      break;
    }
  }
  return advance;
}

}  // namespace isojam
