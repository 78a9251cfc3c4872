#include "engine/analysis/trough_classes.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>
#include <vector>

#include "engine/random/stream.hpp"

namespace isojam {
namespace {

constexpr double ff_upper = 0.3, ef_upper = 0.25;

double log_uniform(double from, double to, RandomStream& random) {
  return std::pow(10, from + (to - from) * random.uniform());
}

/// Contacts with known classes. Flat ones have both angles near 1e-9, and edges in faces have θ_ef near 1e-5. The
/// number of all others grows as θ_ef^0.65.
std::vector<Alignment> synthetic(int flat, int edges, int others, RandomStream& random) {
  const auto wide = [&] { return 0.5 * std::pow(1 - random.uniform(), 1 / 0.65); };
  std::vector<Alignment> list;
  for (int i = 0; i < flat; ++i) {
    const double theta = log_uniform(-10, -8, random);
    list.push_back({.face_face = theta, .edge_face = theta * random.uniform()});
  }
  for (int i = 0; i < edges; ++i)
    list.push_back({.face_face = 0.3 + random.uniform(), .edge_face = log_uniform(-5.5, -4.5, random)});
  for (int i = 0; i < others; ++i) list.push_back({.face_face = 0.3 + random.uniform(), .edge_face = wide()});
  return list;
}

TEST(AngleBins, ContainTheirAngles) {
  RandomStream random{60};
  for (int trial = 0; trial < 2000; ++trial) {
    const double theta = log_uniform(-12, 0.49, random);
    const int k = angle_bin(theta);
    EXPECT_LE(angle_bin_edge(k), theta);
    EXPECT_LT(theta, angle_bin_edge(k + 1));
  }
  for (int k = 0; k < angle_bins; ++k) {
    EXPECT_EQ(angle_bin(angle_bin_edge(k)), k);
    EXPECT_EQ(angle_bins_below(angle_bin_edge(k)), k);
    EXPECT_NEAR(std::log10(angle_bin_edge(k)), -12 + 0.05 * k, 1e-12);
  }
  EXPECT_EQ(angle_bin(0), 0);
  EXPECT_EQ(angle_bin(1e-15), 0);
  EXPECT_EQ(angle_bin(std::acos(-1.0)), angle_bins - 1);
  EXPECT_EQ(angle_bins_below(1e-13), 0);
  for (const double wrong : {-1e-3, 4.0, std::nan("")}) EXPECT_THROW(angle_bin(wrong), std::invalid_argument);
}

void expect_equal(const ContactNumbers& a, const ContactNumbers& b) {
  EXPECT_DOUBLE_EQ(a.Z, b.Z);
  EXPECT_DOUBLE_EQ(a.Z_ff, b.Z_ff);
  EXPECT_DOUBLE_EQ(a.Z_ef, b.Z_ef);
  EXPECT_NEAR(a.Z_l, b.Z_l, 1e-12);
  EXPECT_DOUBLE_EQ(a.C, b.C);
}

TEST(AngleHistogram, CountsAsTheClassesDo) {
  RandomStream random{61};
  std::vector<Alignment> list;
  for (int i = 0; i < 400; ++i)
    list.push_back({.face_face = log_uniform(-13, 0.4, random), .edge_face = log_uniform(-13, 0.4, random)});
  const AngleHistogram histogram = angle_histogram(list, ff_upper, ef_upper);
  EXPECT_EQ(histogram.contacts(), 400);
  for (int trial = 0; trial < 200; ++trial) {
    const int ff = static_cast<int>(random.uniform() * (histogram.face_face_window + 1));
    const int ef = static_cast<int>(random.uniform() * (angle_bins + 1));
    const auto edge = [](int k) { return k == 0 ? 0 : angle_bin_edge(k); };
    expect_equal(numbers_in_bins(histogram, 70, ff, ef), contact_numbers(70, classify(list, edge(ff), edge(ef))));
  }
  EXPECT_THROW(numbers_in_bins(histogram, 0, 1, 1), std::invalid_argument);
}

TEST(AngleHistogram, Adds) {
  RandomStream random{62};
  const auto one = synthetic(20, 30, 100, random), two = synthetic(25, 10, 90, random);
  std::vector<Alignment> both = one;
  both.insert(both.end(), two.begin(), two.end());
  AngleHistogram total = angle_histogram(one, ff_upper, ef_upper);
  total.add(angle_histogram(two, 0.2, ef_upper), 1);
  const AngleHistogram expected = angle_histogram(both, 0.2, ef_upper);
  EXPECT_EQ(total.face_face, expected.face_face);
  EXPECT_EQ(total.face_face_window, expected.face_face_window);
  for (int bins = 0; bins <= expected.face_face_window; bins += 7)
    EXPECT_EQ(total.edge_face_of_others(bins), expected.edge_face_of_others(bins));
  AngleHistogram weighted = angle_histogram(one, ff_upper, ef_upper);
  weighted.add(weighted, -0.75);
  expect_equal(numbers_in_bins(weighted, 50, 150, 150),
               numbers_in_bins(angle_histogram(one, ff_upper, ef_upper), 200, 150, 150));
}

TEST(TroughClasses, AreThoseOfSyntheticContacts) {
  RandomStream random{63};
  for (int trial = 0; trial < 20; ++trial) {
    const auto list = synthetic(60, 80, 400, random);
    const AngleHistogram histogram = angle_histogram(list, ff_upper, ef_upper);
    const TroughCutoffs cutoffs = trough_cutoffs(histogram);
    ASSERT_TRUE(cutoffs.has_all());
    const TroughNumbers found = trough_numbers(histogram, 100, cutoffs);
    EXPECT_DOUBLE_EQ(found.numbers.Z, 10.8);
    EXPECT_DOUBLE_EQ(found.numbers.Z_ff, 1.2);
    EXPECT_NEAR(found.numbers.Z_ef, 1.6, 0.2) << "a few of the 400 others are below the trough";
    EXPECT_DOUBLE_EQ(found.numbers.C, 3 * found.numbers.Z_ff + 2 * found.numbers.Z_ef + found.numbers.Z_l);
    EXPECT_LE(found.C_low, found.numbers.C);
    EXPECT_LE(found.numbers.C, found.C_high);
    EXPECT_NEAR(found.C_low, 10.8 + 2 * 1.2 + 1.6, 0.15);
  }
  const TroughCutoffs cutoffs = trough_cutoffs(angle_histogram(synthetic(0, 80, 400, random), ff_upper, ef_upper));
  EXPECT_EQ(cutoffs.face_face.verdict, TroughVerdict::undecided);
  EXPECT_EQ(cutoffs.edge_face.verdict, TroughVerdict::found);
  EXPECT_FALSE(cutoffs.has_all());
}

}  // namespace
}  // namespace isojam
