#include "engine/packing/mixture/mixture.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdio>

#include "engine/geometry/overlap/clipped_overlap.hpp"
#include "engine/packing/envelope/envelope.hpp"
#include "tests/engine/packing/packings.hpp"

namespace isojam {
namespace {

using namespace testing_packings;

/// Octahedra, cubes and tetrahedra. The largest particles are `ratio` times as long as the smallest.
std::vector<Particle> three_shapes(int n, double ratio) {
  return Mixture({{SolidKind::octahedron, .25, {.from = 1}},
                  {SolidKind::cube, .25, {.law = SizeLaw::uniform, .from = 1 / ratio, .to = 1}},
                  {SolidKind::tetrahedron, .5, {.from = 1 / ratio}}},
                 "")
      .particles(n);
}

Packing mixed(int n, double ratio, double density, std::uint64_t seed) {
  RandomStream random{seed, 77};
  return random_packing(three_shapes(n, ratio), density, random);
}

TEST(Mixture, HasExactNumbers) {
  const Mixture mixture({{SolidKind::octahedron, .5}, {SolidKind::cube, .3}, {SolidKind::tetrahedron, .2}}, "");
  EXPECT_EQ(mixture.counts(10), (std::vector<int>{5, 3, 2}));
  EXPECT_EQ(mixture.counts(64), (std::vector<int>{32, 19, 13}));
  EXPECT_EQ(mixture.counts(1), (std::vector<int>{1, 0, 0}));
  for (int n = 1; n < 300; ++n) {
    const std::vector<int> counts = mixture.counts(n);
    EXPECT_EQ(counts[0] + counts[1] + counts[2], n);
    for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(counts[k], mixture.kinds()[k].fraction * n, 1) << n;
  }
}

TEST(Mixture, HasTheSizesOfItsDistributionAndMeanVolumeOne) {
  constexpr int n = 5000;
  const Mixture uniform({{SolidKind::cube, 1, {.law = SizeLaw::uniform, .from = .5, .to = 1.5}}}, ""),
      log_normal({{SolidKind::cube, 1, {.law = SizeLaw::log_normal, .from = 2, .sigma = .3}}}, ""),
      discrete({{SolidKind::cube, 1, {.law = SizeLaw::discrete, .list = {{1, .25}, {1.4, .75}}}}}, "");
  for (const Mixture& mixture : {uniform, log_normal, discrete}) {
    double volume = 0;
    for (const Particle& particle : mixture.particles(n)) volume += std::pow(particle.scale, 3);
    EXPECT_NEAR(volume / n, 1, 1e-12) << mixture.name();
  }
  // Moments of the distributions. For sizes uniform on [a, b], the mean volume is (b⁴ − a⁴)/(4 (b − a)).
  double mean = 0, log_mean = 0, log_square = 0;
  for (const Particle& particle : uniform.particles(n)) mean += particle.scale / n;
  EXPECT_NEAR(mean, std::cbrt(4 / (std::pow(1.5, 4) - std::pow(.5, 4))), 1e-6);
  for (const Particle& particle : log_normal.particles(n)) {
    const double x = 3 * std::log(particle.scale);
    log_mean += x / n, log_square += x * x / n;
  }
  EXPECT_NEAR(log_mean, -.09 / 2, 1e-3) << "the mean volume of a log-normal law is exp(σ²/2) of the median";
  EXPECT_NEAR(std::sqrt(log_square - log_mean * log_mean), .3, 1e-3);
  const std::vector<Particle> two = discrete.particles(n);
  EXPECT_EQ(std::count(two.begin(), two.end(), two.front()), n / 4);
  EXPECT_NEAR(two.back().scale / two.front().scale, 1.4, 1e-15);
}

TEST(Mixture, OfOneSizeIsTheSolid) {
  const Mixture one({{SolidKind::octahedron, 1, {.from = 7}}}, "");
  EXPECT_TRUE(one.is_one_solid());
  RandomStream a{5}, b{5};
  const Packing of_mixture = random_packing(one.particles(60), .6, a),
                of_solid = random_packing(platonic(SolidKind::octahedron), 60, .6, b);
  EXPECT_TRUE(of_mixture.solids.is_uniform());
  EXPECT_TRUE(of_mixture.solids == of_solid.solids);
  EXPECT_EQ(of_mixture.poses, of_solid.poses);
  const Mixture equal({{SolidKind::octahedron, .5, {.from = 2}}, {SolidKind::cube, .5, {.from = 2}}}, "");
  for (const Particle& particle : equal.particles(11)) EXPECT_EQ(particle.scale, 1);
}

TEST(Mixture, OrderDependsOnlyOnTheSeed) {
  const Packing one = mixed(100, 5, .5, 1), same = mixed(100, 5, .5, 1), other = mixed(100, 5, .5, 2);
  EXPECT_TRUE(one.solids == same.solids);
  EXPECT_FALSE(one.solids == other.solids);
  int along = 0;  // number of successive particles of the same kind, which is about half of all
  for (std::size_t i = 1; i < 100; ++i) along += one.solids.kind(i) == one.solids.kind(i - 1);
  EXPECT_GT(along, 20);
  EXPECT_LT(along, 60);
}

void expect_same_pairs(const Packing& packing, double skin) {
  const auto found = find_in_reach(packing, skin), expected = find_in_reach_brute_force(packing, skin);
  ASSERT_EQ(found.size(), expected.size()) << describe(packing);
  for (std::size_t k = 0; k < found.size(); ++k) EXPECT_EQ(canonical_key(found[k]), canonical_key(expected[k])) << k;
}

TEST(MixtureNeighbours, AgreeWithASearchOverAllPairs) {
  for (const double ratio : {1.0, 1.4, 3.0, 10.0, 30.0}) {
    for (const int n : {40, 400, 1500}) {
      const Packing packing = mixed(std::max(n, least_particles(platonic(SolidKind::cube), .5) * 8), ratio, .5, 3);
      expect_same_pairs(packing, .1);
      DoubleDoubleMatrix shear;
      shear.high(0, 1) = .4, shear.high(1, 2) = -.3;
      expect_same_pairs(deformed(packing, shear), .1);
    }
  }
}

TEST(MixtureNeighbours, LargeParticlesDoNotAddPairsOfSmallOnes) {
  // One particle in a hundred is ten times as long as the others, and has a thousand times their volume.
  const std::vector<Particle> particles =
      Mixture({{SolidKind::octahedron, .99}, {SolidKind::octahedron, .01, {.from = 10}}}, "").particles(4000);
  RandomStream random{9};
  const Packing packing = random_packing(particles, .3, random);
  const auto by_own = find_in_reach(packing, .05).size(),
             by_largest = find_neighbours(packing, 2 * packing.solids.greatest_circumradius() + .05).size();
  std::printf("pairs by own radii %zu, by the largest radius %zu\n", by_own, by_largest);
  EXPECT_LT(10 * by_own, by_largest);
}

TEST(MixtureEnvelope, IsTheEnergyAndHasItsSlopes) {
  const Packing packing = mixed(150, 3, .8, 5);
  const Evaluation exact = PackingEnergy().evaluate(packing, Precision::double_double);
  EnvelopeEnergy envelope;
  const double stiffness = 100 * exact.mean_force / .02;  // ghosts move by less than the depth of a contact
  const EnvelopeEvaluation unshifted = envelope.unshifted(packing, stiffness);
  EXPECT_NEAR(unshifted.value, exact.energy, 1e-12 * exact.energy);
  EXPECT_LE((unshifted.gradient - exact.gradient).norm(), 1e-12 * exact.gradient.norm());
  RandomStream random{6};
  std::vector<ContactMultiplier> forces = forces_of(unshifted);
  for (ContactMultiplier& force : forces) {
    const double size = force.multiplier.norm() / 4;
    for (double& entry : force.multiplier) entry += size * random.normal();
  }
  const EnvelopeEvaluation here = envelope.evaluate(packing, forces, {stiffness});
  const BlockMatrix curvature_here = curvature(here, packing.size());
  double longest = 0;
  for (const EnvelopeContact& contact : here.contacts) longest = std::max(longest, contact.at->shift.norm());
  EXPECT_LT(longest, 1e-2);
  for (int k = 0; k < 4; ++k) {
    const Eigen::VectorXd u = random_step(random, packing.size()).normalized();
    const double h = 1e-6;
    const EnvelopeEvaluation ahead = envelope.evaluate(moved(packing, h * u), forces, {stiffness}),
                             behind = envelope.evaluate(moved(packing, -h * u), forces, {stiffness});
    const double slope = (ahead.value - behind.value) / (2 * h);
    EXPECT_NEAR(slope, here.gradient.dot(u), 1e-6 * here.gradient.norm()) << k;
    const Eigen::VectorXd model = curvature_here * u;
    EXPECT_LT(((ahead.gradient - behind.gradient) / (2 * h) - model).norm(), 20 * longest * model.norm())
        << "right to first order in the shifts";
  }
}

TEST(MixtureSteps, RotateEachParticleWithItsOwnRadius) {
  const Packing packing = mixed(80, 4, .4, 7);
  Eigen::VectorXd step = Eigen::VectorXd::Zero(6 * packing.size());
  for (int i = 0; i < packing.size(); ++i) step[6 * i + 5] = .1;
  const Packing turned = moved(packing, step);
  for (std::size_t i = 0; i < packing.poses.size(); ++i) {
    const Eigen::AngleAxisd turn(turned.poses[i].orientation * packing.poses[i].orientation.conjugate());
    EXPECT_NEAR(turn.angle() * packing.solids[i].gyration_radius(), .1, 1e-12);
    EXPECT_NEAR(packing.solids[i].gyration_radius(),
                packing.solids.unit(i).gyration_radius() * packing.solids[i].scale(), 1e-15);
  }
}

}  // namespace
}  // namespace isojam
