// Properties tested here, with random numbers of both signs and all magnitudes:
// - Every operation on a vector of four numbers (lanes) does in each lane what its comment states: sums and products
//   within rounding errors, all others exactly.
// - A tag, an integer in the last bits of a number, is still there after the largest or smallest number was selected.
//   It changes the number by at most 64 ulp.
// - equal_unions() finds the edges of which, for every plane, at least one end is inside.

#include "engine/geometry/overlap/lanes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "engine/random/stream.hpp"

namespace isojam {
namespace {

constexpr int cases = 200;
constexpr double epsilon = std::numeric_limits<double>::epsilon();
using Four = std::array<double, 4>;

Four random_four(RandomStream& random) {
  Four x;
  for (double& value : x) value = random.normal() * std::exp(10 * random.normal());
  return x;
}

Four stored(Lanes a) {
  alignas(32) Four x;
  a.store(x.data());
  return x;
}

Lanes loaded(const Four& x) { return Lanes::load(x.data()); }

/// Expected value of each lane, and its tolerance.
template <class Expected>
void expect_lanes(Lanes found, const Expected& expected, double tolerance = 0) {
  const Four x = stored(found);
  for (int k = 0; k < 4; ++k) EXPECT_NEAR(x[k], expected(k), tolerance) << "lane " << k;
}

TEST(LanesTest, ArithmeticActsOnEachLane) {
  RandomStream random{7, 1};
  for (int n = 0; n < cases; ++n) {
    const Four x = random_four(random), y = random_four(random), z = random_four(random);
    const Lanes a = loaded(x), b = loaded(y), c = loaded(z);
    expect_lanes(a + b, [&](int k) { return x[k] + y[k]; });
    expect_lanes(a - b, [&](int k) { return x[k] - y[k]; });
    expect_lanes(a * b, [&](int k) { return x[k] * y[k]; });
    expect_lanes(a / b, [&](int k) { return x[k] / y[k]; });
    expect_lanes(min(a, b), [&](int k) { return std::min(x[k], y[k]); });
    expect_lanes(max(a, b), [&](int k) { return std::max(x[k], y[k]); });
    expect_lanes(absolute(a), [&](int k) { return std::abs(x[k]); });
    for (int k = 0; k < 4; ++k) {
      const double scale = std::abs(x[k] * y[k]) + std::abs(z[k]);
      EXPECT_NEAR(stored(fma(a, b, c))[k], x[k] * y[k] + z[k], 2 * epsilon * scale);
      EXPECT_NEAR(stored(fma_minus(a, b, c))[k], x[k] * y[k] - z[k], 2 * epsilon * scale);
    }
  }
}

TEST(LanesTest, SelectionsChooseTheCorrectLanes) {
  RandomStream random{7, 2};
  for (int n = 0; n < cases; ++n) {
    const Four x = random_four(random), y = random_four(random);
    const Lanes a = loaded(x), b = loaded(y);
    expect_lanes(where_negative(a, a, b), [&](int k) { return x[k] < 0 ? x[k] : y[k]; });
    expect_lanes(where_negative(equal(a, halves(a, b)), Lanes::all(1), Lanes::all(0)), [](int k) { return k < 2; });
    expect_lanes(halves(a, b), [&](int k) { return k < 2 ? x[k] : y[k]; });
    expect_lanes(without_fourth(a), [&](int k) { return k < 3 ? x[k] : 0; });
    expect_lanes(yzx(a), [&](int k) { return x[std::array{1, 2, 0, 3}[k]]; });
    expect_lanes(yzwx(a), [&](int k) { return x[(k + 1) % 4]; });
    expect_lanes(swapped_pairs(a), [&](int k) { return x[k ^ 1]; });
    expect_lanes(swapped_halves(a), [&](int k) { return x[k ^ 2]; });
    expect_lanes(lane<0>(a), [&](int) { return x[0]; });
    expect_lanes(lane<3>(a), [&](int) { return x[3]; });
    unsigned negative = 0;
    for (int k = 0; k < 4; ++k) negative |= unsigned{x[k] < 0} << k;
    EXPECT_EQ(sign_bits(a), negative);
    EXPECT_EQ(a.first(), x[0]);
  }
}

TEST(LanesTest, ReductionsIncludeEveryLane) {
  RandomStream random{7, 3};
  for (int n = 0; n < cases; ++n) {
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

TEST(LanesTest, TagsStayWithTheExtreme) {
  RandomStream random{7, 4};
  for (int n = 0; n < cases; ++n) {
    const Four x = random_four(random);
    const int first = 4 * static_cast<int>(15.99 * random.uniform());
    const double best = greatest(tagged<64>(loaded(x), first)).first();
    const auto where = std::max_element(x.begin(), x.end());
    EXPECT_EQ(tag_of<64>(best), static_cast<std::uint32_t>(first + (where - x.begin())));
    EXPECT_NEAR(best, *where, 64 * epsilon * std::abs(*where));
  }
}

TEST(LanesTest, EqualUnionsAgreeWithALoopOverBytes) {
  RandomStream random{7, 5};
  int found = 0;
  for (int n = 0; n < cases; ++n) {
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
      const bool whole = ((bytes >> 8 * tail[e] | bytes >> 8 * head[e]) & 0xFF) == all;
      EXPECT_EQ(mask >> e & 1, whole) << "edge " << e;
      found += whole;
    }
  }
  EXPECT_GT(found, cases) << "too few to prove anything";
}

}  // namespace
}  // namespace isojam
