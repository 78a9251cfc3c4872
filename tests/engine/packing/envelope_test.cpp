#include "engine/packing/envelope/envelope.hpp"

#include <gtest/gtest.h>
#include <oneapi/tbb/global_control.h>

#include <algorithm>

#include "engine/packing/energy.hpp"
#include "tests/engine/packing/packings.hpp"

namespace isojam {
namespace {

constexpr double density = 0.8;

bool same_bits(const EnvelopeEvaluation& p, const EnvelopeEvaluation& q) {
  return p.value == q.value && p.gradient == q.gradient && p.contacts.size() == q.contacts.size() &&
         std::equal(p.contacts.begin(), p.contacts.end(), q.contacts.begin(), [](const auto& c, const auto& d) {
           return c.at->shift == d.at->shift && c.at->wrench == d.at->wrench && c.at->root == d.at->root;
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
