#include "engine/packing/envelope/envelope.hpp"

#include <gtest/gtest.h>
#include <oneapi/tbb/global_control.h>

#include <algorithm>
#include <cstdio>
#include <limits>

#include "engine/packing/energy.hpp"
#include "tests/engine/packing/packings.hpp"

namespace isojam {
namespace {

using testing_packings::epsilon;

constexpr double density = 0.8;

bool same_bits(const EnvelopeEvaluation& p, const EnvelopeEvaluation& q) {
  return p.value == q.value && p.gradient == q.gradient && p.contacts.size() == q.contacts.size() &&
         std::equal(p.contacts.begin(), p.contacts.end(), q.contacts.begin(), [](const auto& c, const auto& d) {
           return c.at.shift == d.at.shift && c.at.wrench == d.at.wrench && c.at.root == d.at.root;
         });
}

/// Multipliers of the contacts, each changed at random by about its own size.
std::vector<ContactMultiplier> changed(const EnvelopeEvaluation& exact, RandomStream& random) {
  std::vector<ContactMultiplier> forces = forces_of(exact);
  for (ContactMultiplier& force : forces) {
    const double size = force.multiplier.norm() / 2;
    for (double& entry : force.multiplier) entry += size * random.normal();
  }
  return forces;
}

/// A stiffness of the order of this packing's contacts: the mean force divided by a depth.
double some_stiffness(const EnvelopeEvaluation& exact) { return exact.mean_force / 0.02; }

class EnvelopeOf : public testing::TestWithParam<SolidKind> {
 protected:
  void SetUp() override { packing_ = testing_packings::sample(GetParam(), 60, density, 311); }

  Packing packing_{platonic(SolidKind::cube), PeriodicCell(1), {}};
};
INSTANTIATE_TEST_SUITE_P(Solids, EnvelopeOf, testing::ValuesIn(all_solids),
                         [](const auto& test) { return std::string(to_string(test.param)); });

TEST_P(EnvelopeOf, UnshiftedIsTheEnergy) {
  EnvelopeEnergy envelope;
  const EnvelopeEvaluation here = envelope.unshifted(packing_, 1);
  const Evaluation energy = PackingEnergy().evaluate(packing_, Precision::double_double);
  EXPECT_EQ(here.touching, energy.contacts);
  EXPECT_NEAR(here.value, energy.energy, 100 * epsilon * energy.energy);
  EXPECT_NEAR(here.mean_force, energy.mean_force, 100 * epsilon * energy.mean_force);
  EXPECT_LT((here.gradient - energy.gradient).norm(), 1e3 * epsilon * energy.gradient.norm());
  EXPECT_EQ(here.multiplier_error, 0);
  const EnvelopeEvaluation again = envelope.evaluate(packing_, forces_of(here), {some_stiffness(here)});
  EXPECT_NEAR(again.value, here.value, 1e-9 * here.value);
  EXPECT_LT((again.gradient - here.gradient).norm(), 1e-9 * here.gradient.norm());
  EXPECT_LT(again.multiplier_error, 1e-8 * here.mean_force);
}

TEST_P(EnvelopeOf, DerivativesAgreeWithDifferences) {
  RandomStream random{312, static_cast<std::uint64_t>(GetParam())};
  EnvelopeEnergy envelope;
  const EnvelopeEvaluation exact = envelope.unshifted(packing_, 1);
  // The stiffness is so large that shifts are small, although the contacts of a random packing overlap deeply.
  const double stiffness = 100 * some_stiffness(exact);
  const std::vector<ContactMultiplier> forces = changed(exact, random);
  const EnvelopeEvaluation here = envelope.evaluate(packing_, forces, {stiffness});
  const Eigen::VectorXd along = testing_packings::random_step(random, packing_.size());
  const double h = 1e-6;
  const EnvelopeEvaluation forth = envelope.evaluate(moved(packing_, h * along), forces, {stiffness});
  const EnvelopeEvaluation back = envelope.evaluate(moved(packing_, -h * along), forces, {stiffness});
  const double slope = here.gradient.dot(along), difference = (forth.value - back.value) / (2 * h);
  const Eigen::VectorXd bend = curvature(here, packing_.size()) * along;
  const Eigen::VectorXd bend_difference = (forth.gradient - back.gradient) / (2 * h);
  const double error = (bend - bend_difference).norm() / bend.norm();
  double longest = 0;
  for (const EnvelopeContact& contact : here.contacts) longest = std::max(longest, contact.at.shift.norm());
  std::printf("slope %.9e, by differences %.9e; curvature to %.1e, longest shift %.1e\n", slope, difference, error,
              longest);
  EXPECT_NEAR(slope, difference, 1e-6 * here.gradient.norm() * along.norm());
  EXPECT_LT(error, 20 * longest) << "right to first order in the shifts";
}

TEST_P(EnvelopeOf, LiesBelowTheEnergyAndGrowsWithTheStiffness) {
  RandomStream random{313, static_cast<std::uint64_t>(GetParam())};
  EnvelopeEnergy envelope;
  const EnvelopeEvaluation exact = envelope.unshifted(packing_, 1);
  const std::vector<ContactMultiplier> forces = changed(exact, random);
  double last = -std::numeric_limits<double>::infinity();
  for (const double factor : {1.0, 10.0, 100.0, 1e6}) {
    const EnvelopeEvaluation here = envelope.evaluate(packing_, forces, {factor * some_stiffness(exact)});
    EXPECT_GE(here.value, last);
    EXPECT_LE(here.value, exact.value * (1 + 1e-12));
    last = here.value;
  }
  EXPECT_NEAR(last, exact.value, 1e-3 * exact.value) << "nothing gives way";
}

TEST_P(EnvelopeOf, FlaggedParticlesGiveOnlyTheirContacts) {
  RandomStream random{314, static_cast<std::uint64_t>(GetParam())};
  EnvelopeEnergy envelope;
  const EnvelopeEvaluation exact = envelope.unshifted(packing_, 1);
  const std::vector<ContactMultiplier> forces = changed(exact, random);
  const EnvelopeEvaluation whole = envelope.evaluate(packing_, forces, {some_stiffness(exact)});
  std::vector<char> flags(packing_.poses.size(), 0);
  for (int k = 0; k < 5; ++k) flags[static_cast<std::size_t>(60 * random.uniform())] = 1;
  const EnvelopeEvaluation part = envelope.evaluate(packing_, forces, {some_stiffness(exact)}, flags);
  std::size_t next = 0;
  for (const EnvelopeContact& contact : whole.contacts) {
    if (!flags[contact.pair.a] && !flags[contact.pair.b]) continue;
    ASSERT_LT(next, part.contacts.size());
    EXPECT_EQ(canonical_key(part.contacts[next].pair), canonical_key(contact.pair));
    EXPECT_EQ(part.contacts[next].at.wrench, contact.at.wrench);
    ++next;
  }
  EXPECT_EQ(next, part.contacts.size());
  EXPECT_GT(next, 0U);
}

TEST_P(EnvelopeOf, CombinesMovedAndUnchangedContacts) {
  RandomStream random{317, static_cast<std::uint64_t>(GetParam())};
  EnvelopeEnergy envelope;
  const EnvelopeEvaluation exact = envelope.unshifted(packing_, 1);
  const std::vector<ContactMultiplier> forces = changed(exact, random);
  const double stiffness = some_stiffness(exact);
  const EnvelopeEvaluation before = envelope.evaluate(packing_, forces, {stiffness});
  std::vector<char> flags(static_cast<std::size_t>(packing_.size()), 0);
  Eigen::VectorXd step = Eigen::VectorXd::Zero(6 * packing_.size());
  for (const int p : {3, 17, 40, 41}) {
    flags[static_cast<std::size_t>(p)] = 1;
    for (double& entry : step.segment<6>(6 * p)) entry = 0.03 * random.normal();
  }
  EXPECT_TRUE(same_bits(part_of(before, flags), envelope.evaluate(packing_, forces, {stiffness}, flags)));
  const Packing there = moved(packing_, step);
  const EnvelopeEvaluation whole = envelope.evaluate(there, forces, {stiffness});
  const EnvelopeEvaluation made_up = with_part(before, envelope.evaluate(there, forces, {stiffness}, flags), flags);
  EXPECT_TRUE(same_bits(made_up, whole)) << made_up.contacts.size() << " and " << whole.contacts.size() << " contacts";
  EXPECT_EQ(made_up.mean_force, whole.mean_force);
  EXPECT_EQ(made_up.touching, whole.touching);
  EXPECT_FALSE(same_bits(made_up, before));
}

TEST_P(EnvelopeOf, EarlierEvaluationsChangeNoBit) {
  RandomStream random{315, static_cast<std::uint64_t>(GetParam())};
  const EnvelopeEvaluation exact = EnvelopeEnergy().unshifted(packing_, 1);
  const std::vector<ContactMultiplier> forces = changed(exact, random);
  const double stiffness = some_stiffness(exact);
  const EnvelopeEvaluation fresh = EnvelopeEnergy().evaluate(packing_, forces, {stiffness});
  EnvelopeEnergy used;
  Eigen::VectorXd one = Eigen::VectorXd::Zero(6 * packing_.size());
  one.head<6>().setConstant(0.01);
  used.evaluate(moved(packing_, one), forces, {stiffness});
  used.evaluate(testing_packings::sample(GetParam(), 60, density, 316), {}, {stiffness});
  used.evaluate(moved(packing_, one), {}, {stiffness});
  EXPECT_TRUE(same_bits(fresh, used.evaluate(packing_, forces, {stiffness})));
  for (const std::size_t threads : {1U, 2U}) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    EXPECT_TRUE(same_bits(fresh, EnvelopeEnergy().evaluate(packing_, forces, {stiffness}))) << threads << " threads";
  }
}

}  // namespace
}  // namespace isojam
