#include "engine/random/stream.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <set>
#include <string_view>

namespace isojam {
namespace {

TEST(RandomStreamTest, BitsAreThoseOfTheStandard) {
  RandomStream random{20110711, 3, 0x123456789abcdef0};
  for (const std::uint64_t bits : {0xee8564ad99ac734aU, 0xb6c712400377496eU, 0x47d373c690792e71U, 0xd86a6756b4d5ac43U})
    EXPECT_EQ(random.bits(), bits);
}

TEST(RandomStreamTest, EqualKeysGiveEqualStreams) {
  RandomStream one{7, 8, 9}, two{7, 8, 9};
  for (int k = 0; k < 1000; ++k) ASSERT_EQ(one.bits(), two.bits()) << "draw " << k;
  RandomStream copy = one;
  for (int k = 0; k < 1000; ++k) ASSERT_EQ(one.normal(), copy.normal()) << "draw " << k;
}

TEST(RandomStreamTest, DifferentKeysGiveDifferentStreams) {
  const std::uint64_t high = std::uint64_t{1} << 32;
  std::array streams{RandomStream{1, 2},    RandomStream{2, 1},    RandomStream{1, 3},
                     RandomStream{1, 2, 0}, RandomStream{0, 1, 2}, RandomStream{1, 2 + high},
                     RandomStream{1, high}, RandomStream{1},       RandomStream{0},
                     RandomStream{}};
  std::set<std::uint64_t> seen;
  for (RandomStream& stream : streams) {
    for (int k = 0; k < 100; ++k) seen.insert(stream.bits());
  }
  // Among so many different streams, equal numbers occur by chance with probability 3e-14.
  EXPECT_EQ(seen.size(), 100 * streams.size());
}

TEST(RandomStreamTest, UniformsUseTheUpperBits) {
  RandomStream random{11}, same{11};
  for (int k = 0; k < 1000; ++k) {
    const double u = random.uniform();
    ASSERT_EQ(std::ldexp(u, 53), static_cast<double>(same.bits() >> 11)) << "draw " << k;
    ASSERT_TRUE(u >= 0 && u < 1) << u;
  }
}

constexpr int draws = 200000;
/// Tolerance of a mean of `draws` values, in standard errors. With a random seed, one test in 1.7 million would fail.
constexpr double standard_errors = 5;

TEST(RandomStreamTest, UniformsAreEvenlySpreadAndUncorrelated) {
  RandomStream random{12};
  constexpr int bins = 64;
  std::array<double, bins> count{};
  double product = 0, last = random.uniform();
  for (int k = 0; k < draws; ++k) {
    const double u = random.uniform();
    ++count[static_cast<std::size_t>(u * bins)];
    product += (u - .5) * (last - .5);
    last = u;
  }
  double chi_squared = 0;
  const double expected = static_cast<double>(draws) / bins;
  for (const double n : count) chi_squared += (n - expected) * (n - expected) / expected;
  EXPECT_NEAR(chi_squared, bins - 1, standard_errors * std::sqrt(2.0 * (bins - 1)));
  EXPECT_NEAR(product / draws, 0, standard_errors / 12 / std::sqrt(draws));
}

TEST(RandomStreamTest, NormalsHaveTheirMoments) {
  RandomStream random{13};
  std::array<double, 5> moment{};
  double product = 0, last = random.normal();
  for (int k = 0; k < draws; ++k) {
    const double x = random.normal();
    for (std::size_t p = 1; p < moment.size(); ++p) moment[p] += std::pow(x, p) / draws;
    product += x * last / draws;
    last = x;
  }
  // ⟨x^p⟩ of the standard normal distribution, and the variance of x^p, which is ⟨x^2p⟩ − ⟨x^p⟩².
  const std::array<double, 5> exact{1, 0, 1, 0, 3}, variance{0, 1, 2, 15, 96};
  for (std::size_t p = 1; p < moment.size(); ++p)
    EXPECT_NEAR(moment[p], exact[p], standard_errors * std::sqrt(variance[p] / draws)) << "moment " << p;
  EXPECT_NEAR(product, 0, standard_errors / std::sqrt(draws));
}

TEST(HashTextTest, IsFnv1a) {
  const auto hash = [](std::string_view text) { return hash_of(text); };
  // Published test vectors.
  EXPECT_EQ(hash(""), 0xcbf29ce484222325U);
  EXPECT_EQ(hash("a"), 0xaf63dc4c8601ec8cU);
  EXPECT_EQ(hash("foobar"), 0x85944171f73967e8U);
}

}  // namespace
}  // namespace isojam
