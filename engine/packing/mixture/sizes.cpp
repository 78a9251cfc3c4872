#include "engine/packing/mixture/sizes.hpp"

#include <cassert>
#include <charconv>
#include <cstddef>

#include "engine/arithmetic/distributions.hpp"
#include "engine/arithmetic/elementary.hpp"
#include "engine/random/stream.hpp"

namespace isojam {

double Sizes::of_particle(int k, int n) const {
  if (take == SizeChoice::in_order) return values[static_cast<std::size_t>(k) % values.size()];
  if (take == SizeChoice::quantiles) return quantile((k + 0.5) / n);
  RandomStream random{seed, static_cast<std::uint64_t>(k)};
  double share = 0;
  while (!(share > 0)) share = random.uniform();
  return quantile(share);
}

double Sizes::quantile(double share) const {
  assert(share > 0 && share < 1);
  switch (law) {
    case SizeLaw::fixed: return from;
    case SizeLaw::uniform: return from + (to - from) * share;
    case SizeLaw::log_normal: return from * nearest::exp(sigma / 3 * normal_quantile(share));
    case SizeLaw::values: return values[static_cast<std::size_t>(share * static_cast<double>(values.size()))];
    case SizeLaw::discrete: break;
  }
  double below = 0;
  for (const SizeShare& each : list) {
    below += each.fraction;
    if (share <= below) return each.size;
  }
  return list.back().size;
}

std::string Sizes::text() const {
  auto chosen = law_text();
  if (take == SizeChoice::quantiles) return chosen;
  return chosen + '_' + std::string(to_string(take)) + (take == SizeChoice::drawn ? std::to_string(seed) : "");
}

std::string Sizes::law_text() const {
  std::string text;
  switch (law) {
    case SizeLaw::values:
      for (const double size : values) text.append(text.empty() ? 0 : 1, '_').append(shortest_text(size));
      return text;
    case SizeLaw::fixed: return from == 1 ? "" : shortest_text(from);
    case SizeLaw::uniform: return shortest_text(from).append("to").append(shortest_text(to));
    case SizeLaw::log_normal: return shortest_text(from).append("ln").append(shortest_text(sigma));
    case SizeLaw::discrete: break;
  }
  for (const SizeShare& each : list)
    text.append(text.empty() ? 0 : 1, '_')
        .append(shortest_text(each.fraction))
        .append("of")
        .append(shortest_text(each.size));
  return text;
}

std::string shortest_text(double x) {
  std::array<char, 32> digits{};
  const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), x).ptr;
  return {digits.data(), end};
}

}  // namespace isojam
