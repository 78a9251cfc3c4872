#include "engine/arithmetic/lanes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>

#include "engine/random/stream.hpp"

namespace isojam {
namespace {

constexpr int repetitions = 200;
constexpr double epsilon = std::numeric_limits<double>::epsilon();
using Four = std::array<double, 4>;

Four random_four(RandomStream& random, double share_of_special_values = 0) {
  constexpr double infinity = std::numeric_limits<double>::infinity(), nan = std::numeric_limits<double>::quiet_NaN();
  constexpr std::array special{0.0, -0.0, 1.0, -1.0, infinity, -infinity, nan, -nan};
  Four x;
  for (double& value : x) {
    value = random.normal() * std::exp(10 * random.normal());
    if (random.uniform() < share_of_special_values) value = special[static_cast<std::size_t>(8 * random.uniform())];
  }
  return x;
}

Four stored(Lanes a) {
  alignas(32) Four x;
  a.store(x.data());
  return x;
}

Lanes loaded(const Four& x) { return Lanes::load(x.data()); }

/// Checks every lane against expected(k): its bits, or the number with a tolerance.
template <class Expected>
void expect_lanes(Lanes found, const Expected& expected, std::optional<double> tolerance = {}) {
  const Four x = stored(found);
  for (int k = 0; k < 4; ++k) {
    const double y = expected(k);
    const bool same = tolerance ? std::abs(x[k] - y) <= *tolerance
                                : std::bit_cast<std::uint64_t>(x[k]) == std::bit_cast<std::uint64_t>(y);
    EXPECT_TRUE(same) << x[k] << " instead of " << y << " in lane " << k;
  }
}

TEST(LanesTest, ArithmeticActsOnEachLane) {
  RandomStream random{7, 1};
  for (int n = 0; n < repetitions; ++n) {
    const Four x = random_four(random), y = random_four(random), z = random_four(random);
    const Lanes a = loaded(x), b = loaded(y), c = loaded(z);
    expect_lanes(a + b, [&](int k) { return x[k] + y[k]; });
    expect_lanes(a - b, [&](int k) { return x[k] - y[k]; });
    expect_lanes(a * b, [&](int k) { return x[k] * y[k]; });
    expect_lanes(a / b, [&](int k) { return x[k] / y[k]; });
    expect_lanes(fma(a, b, c), [&](int k) { return std::fma(x[k], y[k], z[k]); });
    expect_lanes(fma_minus(a, b, c), [&](int k) { return std::fma(x[k], y[k], -z[k]); });
    expect_lanes(square_root(absolute(a)), [&](int k) { return std::sqrt(std::abs(x[k])); });
  }
}

TEST(LanesTest, SelectionsChooseTheCorrectLanes) {
  RandomStream random{7, 2};
  for (int n = 0; n < 10 * repetitions; ++n) {
    const Four x = random_four(random, 0.5), y = random_four(random, 0.5);
    const Lanes a = loaded(x), b = loaded(y);
    expect_lanes(min(a, b), [&](int k) { return x[k] < y[k] ? x[k] : y[k]; });
    expect_lanes(max(a, b), [&](int k) { return x[k] > y[k] ? x[k] : y[k]; });
    expect_lanes(absolute(a), [&](int k) { return std::abs(x[k]); });
    expect_lanes(-a, [&](int k) { return -x[k]; });
    expect_lanes(where_negative(a, a, b), [&](int k) { return std::signbit(x[k]) ? x[k] : y[k]; });
    expect_lanes(where_negative(equal(a, b), Lanes::all(1), Lanes::all(0)), [&](int k) { return x[k] == y[k]; });
    expect_lanes(halves(a, b), [&](int k) { return k < 2 ? x[k] : y[k]; });
    expect_lanes(without_fourth(a), [&](int k) { return k < 3 ? x[k] : 0; });
    expect_lanes(yzx(a), [&](int k) { return x[std::array{1, 2, 0, 3}[k]]; });
    expect_lanes(yzwx(a), [&](int k) { return x[(k + 1) % 4]; });
    expect_lanes(swapped_pairs(a), [&](int k) { return x[k ^ 1]; });
    expect_lanes(swapped_halves(a), [&](int k) { return x[k ^ 2]; });
    expect_lanes(lane<0>(a), [&](int) { return x[0]; });
    expect_lanes(lane<3>(a), [&](int) { return x[3]; });
    unsigned negative = 0;
    for (int k = 0; k < 4; ++k) negative |= unsigned{std::signbit(x[k])} << k;
    EXPECT_EQ(sign_bits(a), negative);
  }
}

TEST(LanesTest, ReductionsIncludeEveryLane) {
  RandomStream random{7, 3};
  for (int n = 0; n < repetitions; ++n) {
    const Four x = random_four(random), y = random_four(random);
    expect_lanes(least(loaded(x)), [&](int) { return *std::min_element(x.begin(), x.end()); });
    expect_lanes(greatest(loaded(x)), [&](int) { return *std::max_element(x.begin(), x.end()); });
    double total = 0, scale = 0;
    for (const double value : x) total += value, scale += std::abs(value);
    expect_lanes(
        sum(loaded(x)), [&](int) { return total; }, 4 * epsilon * scale);
    const Four c = stored(yzx(cross_zxy(loaded(x), loaded(y))));
    for (int k = 0; k < 3; ++k) {
      const int i = (k + 1) % 3, j = (k + 2) % 3;
      const double bound = 4 * epsilon * (std::abs(x[i] * y[j]) + std::abs(x[j] * y[i]));
      EXPECT_NEAR(c[k], x[i] * y[j] - x[j] * y[i], bound) << "component " << k;
    }
  }
}

template <std::uint64_t range>
void expect_tags(std::uint64_t seed) {
  RandomStream random{7, seed};
  constexpr auto rounding = static_cast<double>(range) * epsilon;
  for (int n = 0; n < repetitions; ++n) {
    const Four x = random_four(random);
    constexpr int groups = range / 4;
    const int first = 4 * static_cast<int>((groups - 0.01) * random.uniform());
    const Lanes tagged_lanes = tagged<range>(loaded(x), first);
    const double largest = greatest(tagged_lanes).first(), smallest = least(tagged_lanes).first();
    const auto [low, high] = std::minmax_element(x.begin(), x.end());
    EXPECT_EQ(tag_of<range>(largest), static_cast<std::uint32_t>(first + (high - x.begin())));
    EXPECT_EQ(tag_of<range>(smallest), static_cast<std::uint32_t>(first + (low - x.begin())));
    EXPECT_NEAR(largest, *high, rounding * std::abs(*high));
    EXPECT_NEAR(smallest, *low, rounding * std::abs(*low));
  }
}

TEST(LanesTest, LargestAndSmallestNumberKeepTheirTags) {
  expect_tags<64>(4);
  expect_tags<128>(6);
}

TEST(LanesTest, EqualUnionsAgreeWithALoopOverBytes) {
  RandomStream random{7, 5};
  int found = 0;
  for (int n = 0; n < repetitions; ++n) {
    const std::uint32_t all = n % 2 == 0 ? 0xFF : 0x0F;
    alignas(32) std::uint8_t tail[32] = {}, head[32] = {};
    std::uint64_t bytes = 0;
    for (int v = 0; v < 8; ++v) bytes |= (static_cast<std::uint64_t>(all * random.uniform() + 1) | 0x05) << 8 * v;
    for (int e = 0; e < 16; ++e) {
      tail[e] = static_cast<std::uint8_t>(7.99 * random.uniform());
      head[e] = static_cast<std::uint8_t>(7.99 * random.uniform());
    }
    const std::uint32_t mask = equal_unions(bytes, tail, head, all);
    for (int e = 0; e < 16; ++e) {
      const bool expected = ((bytes >> 8 * tail[e] | bytes >> 8 * head[e]) & 0xFF) == all;
      EXPECT_EQ(mask >> e & 1, expected) << "edge " << e;
      found += expected;
    }
  }
  EXPECT_GT(found, repetitions) << "too few edges with an end inside each plane";
}

}  // namespace
}  // namespace isojam
