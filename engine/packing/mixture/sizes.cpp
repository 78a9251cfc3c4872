#include "engine/packing/mixture/sizes.hpp"

#include <cassert>
#include <charconv>

#include "engine/arithmetic/distributions.hpp"
#include "engine/arithmetic/elementary.hpp"

namespace isojam {

double Sizes::quantile(double share) const {
  assert(share > 0 && share < 1);
  switch (law) {
    case SizeLaw::fixed: return from;
    case SizeLaw::uniform: return from + (to - from) * share;
    case SizeLaw::log_normal: return from * nearest::exp(sigma / 3 * normal_quantile(share));
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
  switch (law) {
    case SizeLaw::fixed: return from == 1 ? "" : shortest_text(from);
    case SizeLaw::uniform: return shortest_text(from).append("to").append(shortest_text(to));
    case SizeLaw::log_normal: return shortest_text(from).append("ln").append(shortest_text(sigma));
    case SizeLaw::discrete: break;
  }
  std::string text;
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
