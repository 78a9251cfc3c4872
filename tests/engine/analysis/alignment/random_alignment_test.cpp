// Closed forms are compared with random orientations by Kolmogorov–Smirnov tests.

#include "engine/analysis/alignment/random_alignment.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <numbers>
#include <stdexcept>

#include "engine/analysis/alignment/alignment.hpp"
#include "engine/analysis/alignment/critical_angles.hpp"
#include "engine/analysis/alignment/empirical_cdf.hpp"
#include "engine/geometry/solids/solid.hpp"
#include "tests/engine/analysis/constructed_contacts.hpp"
#include "tests/oracle/kolmogorov.hpp"
#include "tests/oracle/random_orientations.hpp"

namespace isojam {
namespace {

using Eigen::Vector3d;
using oracle::AlignmentAngles;
using oracle::kolmogorov_distance;
using oracle::kolmogorov_probability;
using oracle::sample_edge_constrained;
using oracle::sample_unconstrained;
using Angle = double AlignmentAngles::*;

constexpr int many = 100000;
/// Allowed deviation of a stratified sample of size n: six times n^(-3/4).
const double of_sampling = 6 * std::pow(65536, -.75);

std::vector<double> column(const std::vector<AlignmentAngles>& sample, Angle angle) {
  std::vector<double> values;
  for (const AlignmentAngles& angles : sample) values.push_back(angles.*angle);
  return values;
}

/// P-value of the Kolmogorov–Smirnov test.
double agreement(const EmpiricalCdf& drawn, const std::function<double(double)>& distribution) {
  return kolmogorov_probability(kolmogorov_distance(drawn, distribution), many);
}

class RandomAlignmentOf : public testing::TestWithParam<SolidKind> {
 protected:
  const ConvexSolid& solid = platonic(GetParam());
  const RandomAlignment ideal{solid};
  RandomStream random{51, static_cast<std::uint64_t>(GetParam())};
};

TEST_P(RandomAlignmentOf, RandomOrientationsFollowTheClosedForms) {
  const std::vector<AlignmentAngles> sample = sample_unconstrained(solid, many, random);
  const EmpiricalCdf face_face = empirical_cdf(column(sample, &AlignmentAngles::face_face));
  const EmpiricalCdf edge_face = empirical_cdf(column(sample, &AlignmentAngles::edge_face));
  const double ff = agreement(face_face, [&](double theta) { return ideal.face_face(theta); });
  const double ef = agreement(edge_face, [&](double theta) { return ideal.edge_face(theta); });
  std::printf("%s: P %.3f for θ_ff, %.3f for θ_ef\n", solid.name().c_str(), ff, ef);
  EXPECT_GT(ff, 1e-3);
  EXPECT_GT(ef, 1e-3);
  // With this number of orientations, the test detects an error of three per cent.
  EXPECT_LT(agreement(face_face, [&](double theta) { return ideal.face_face(1.03 * theta); }), 1e-6);
  EXPECT_LT(agreement(edge_face, [&](double theta) { return ideal.edge_face(1.03 * theta); }), 1e-6);
}

TEST_P(RandomAlignmentOf, RandomRotationsFollowTheConstrainedForm) {
  const std::vector<AlignmentAngles> sample = sample_edge_constrained(solid, many, random);
  const EmpiricalCdf face_face = empirical_cdf(column(sample, &AlignmentAngles::face_face));
  EXPECT_GT(agreement(face_face, [&](double theta) { return ideal.constrained_face_face(theta); }), 1e-3);
  EXPECT_LT(agreement(face_face, [&](double theta) { return ideal.face_face(theta); }), 1e-6);
  double largest = 0;
  for (const AlignmentAngles& angles : sample) largest = std::max(largest, angles.edge_face);
  EXPECT_LT(largest, 1e-14);
  EXPECT_EQ(ideal.constrained_edge_face(largest), 1);
  EXPECT_EQ(ideal.constrained_edge_face(-1e-9), 0);
}

INSTANTIATE_TEST_SUITE_P(Solids, RandomAlignmentOf, testing::ValuesIn(all_solids),
                         [](const auto& solid) { return std::string(to_string(solid.param)); });

const RandomAlignment& octahedral() {
  static const RandomAlignment ideal{platonic(SolidKind::octahedron)};
  return ideal;
}

Randomness compare(const std::vector<double>& angles) {
  return compare_with_random(
      angles, [](double theta) { return octahedral().edge_face(theta); }, octahedral().ef_max());
}

TEST(Randomness, IsFoundForRandomContactsOnly) {
  RandomStream random{53};
  constexpr int sets = 500, n = 400;
  int unlikely = 0;
  for (int set = 0; set < sets; ++set) {
    std::vector<double> angles =
        column(sample_unconstrained(platonic(SolidKind::octahedron), n, random), &AlignmentAngles::edge_face);
    const Randomness drawn = compare(angles);
    EXPECT_EQ(drawn.expected, 0.1 * n);
    unlikely += drawn.verdict != RandomnessVerdict::random;
    std::vector<double> fewer;
    for (const double angle : angles) {
      if (angle > drawn.angle || fewer.size() % 3 == 0) fewer.push_back(angle);
    }
    for (int k = 0; k < n / 10; ++k) angles[k] = 1e-4 * random.uniform();
    EXPECT_EQ(compare(angles).verdict, RandomnessVerdict::hyper_random);
    if (set < 20) {
      EXPECT_EQ(compare(fewer).verdict, RandomnessVerdict::sub_random) << fewer.size();
    }
  }
  EXPECT_LE(unlikely, 0.04 * sets);
}

TEST(Randomness, ProbabilityIsTheBinomialSum) {
  for (const long n : {2L, 5L, 30L}) {
    for (long below = 0; below <= n; ++below) {
      std::vector<double> angles(below, 0.0);
      angles.resize(n, 0.5);
      double at_least = 0, at_most = 0;
      for (long i = 0; i <= n; ++i) {
        const double term =
            std::pow(0.1, i) * std::pow(0.9, n - i) /
            ((static_cast<double>(n) + 1) * std::beta(static_cast<double>(n - i + 1), static_cast<double>(i + 1)));
        (i >= below ? at_least : at_most) += term;
        if (i == below) at_most += term;
      }
      const Randomness found = compare(angles);
      EXPECT_EQ(found.below, below);
      EXPECT_NEAR(found.probability, std::min(at_least, at_most), 1e-10) << below << " of " << n;
    }
  }
}

TEST(Randomness, IsUndecidedForFewContacts) {
  EXPECT_EQ(Randomness().verdict, RandomnessVerdict::not_called);
  EXPECT_EQ(compare({}).verdict, RandomnessVerdict::too_few);
  EXPECT_EQ(compare({0.0}).verdict, RandomnessVerdict::too_few);
  EXPECT_EQ(compare({0.0, 0.0, 0.0}).verdict, RandomnessVerdict::hyper_random);
}

TEST(EmpiricalCdf, CountsValues) {
  RandomStream random{54};
  std::vector<double> values;
  for (int k = 0; k < 200; ++k) values.push_back(std::floor(50 * random.uniform()) / 50);
  const EmpiricalCdf cdf = empirical_cdf(values);
  EXPECT_TRUE(std::is_sorted(cdf.values.begin(), cdf.values.end()));
  EXPECT_LE(cdf.values.size(), 50U);
  for (double x = -0.1; x < 1.1; x += 0.003) {
    const auto below = std::count_if(values.begin(), values.end(), [&](double value) { return value <= x; });
    EXPECT_EQ(cdf(x), static_cast<double>(below) / 200) << x;
  }
  EXPECT_EQ(cdf(cdf.values.front()), cdf.heights.front());
  EXPECT_EQ(cdf.heights.back(), 1);
  EXPECT_EQ(empirical_cdf({})(0.5), 0);
  EXPECT_THROW(empirical_cdf(std::vector<double>{1, std::numeric_limits<double>::quiet_NaN()}), std::invalid_argument);
}

TEST_P(RandomAlignmentOf, StratifiedSampleAgreesWithTheClosedForm) {
  const RandomAlignment sampled(solid, RandomAlignment::Way::sampled);
  ASSERT_TRUE(sampled.is_sampled());
  const auto expect_near = [&](const auto& exact, const auto& found, double largest, double allowed, const char* what) {
    double worst = 0;
    for (int k = 1; k < 300; ++k)
      worst = std::max(worst, std::abs(exact(largest * k / 300) - found(largest * k / 300)));
    std::printf("%s %s: %.1e, %.1f of its error\n", std::string(to_string(GetParam())).c_str(), what, worst,
                6 * worst / of_sampling);
    EXPECT_LE(worst, allowed) << what;
  };
  expect_near([&](double t) { return ideal.face_face(t); }, [&](double t) { return sampled.face_face(t); },
              ideal.ff_max(), of_sampling, "face-face");
  expect_near([&](double t) { return ideal.edge_face(t); }, [&](double t) { return sampled.edge_face(t); },
              ideal.ef_max(), of_sampling, "edge-face");
  expect_near([&](double t) { return ideal.constrained_face_face(t); },
              [&](double t) { return sampled.constrained_face_face(t); }, ideal.constrained_ff_max(), 1.0 / 256,
              "constrained");
}

TEST(RandomAlignment, OfOtherSolidsAgreesWithRandomSamples) {
  RandomStream random{53};
  std::vector<Solid> solids;
  for (const char* name : {"truncated_tetrahedron", "cuboctahedron", "rhombic_dodecahedron", "prism6", "antiprism5"})
    solids.push_back(*Solid::named(name));
  // A pyramid looks different from above and from below.
  const std::vector<Eigen::Vector3d> pyramid{{1, 1, 0}, {-1, 1, 0}, {-1, -1, 0}, {1, -1, 0}, {0, 0, 2}};
  solids.push_back(Solid::made_of("pyramid", pyramid));
  for (const Solid& each : solids) {
    const ConvexSolid& solid = *each;
    const std::string_view name = to_string(each);
    const RandomAlignment ideal(solid);
    ASSERT_TRUE(ideal.is_sampled()) << name;
    const std::vector<AlignmentAngles> free = sample_unconstrained(solid, many, random);
    const std::vector<AlignmentAngles> held = sample_edge_constrained(solid, many, random);
    const auto distance = [](const std::vector<double>& drawn, const std::function<double(double)>& distribution) {
      return kolmogorov_distance(empirical_cdf(drawn), distribution);
    };
    const double chance = 1.63 / std::sqrt(many), allowed = chance + of_sampling;  // 1 % level
    EXPECT_LE(distance(column(free, &AlignmentAngles::face_face), [&](double t) { return ideal.face_face(t); }),
              allowed)
        << name;
    EXPECT_LE(distance(column(free, &AlignmentAngles::edge_face), [&](double t) { return ideal.edge_face(t); }),
              allowed)
        << name;
    EXPECT_LE(
        distance(column(held, &AlignmentAngles::face_face), [&](double t) { return ideal.constrained_face_face(t); }),
        allowed + 1.0 / 256)
        << name;
    EXPECT_NEAR(ideal.face_face(1e-4), static_cast<double>(solid.faces().size()) * 2.5e-9, 1e-15) << name;
  }
}

}  // namespace
}  // namespace isojam
