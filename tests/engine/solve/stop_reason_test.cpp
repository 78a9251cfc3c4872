#include <limits>

#include "engine/solve/minimise/minimise.hpp"
#include "tests/engine/solve/solve_support.hpp"

namespace isojam {
namespace {

class StopReasonOf : public testing::TestWithParam<Method> {
 protected:
  MinimiseOptions options() const {
    MinimiseOptions options;
    options.method = GetParam();
    return options;
  }
};

INSTANTIATE_TEST_SUITE_P(Methods, StopReasonOf,
                         testing::Values(Method::conjugate_gradient, Method::fire, Method::lbfgs, Method::newton),
                         [](const auto& test) { return std::string(to_string(test.param)); });

TEST_P(StopReasonOf, Budget) {
  for (const long budget : {1L, 2L, 7L, 30L}) {
    const Packing start = small_packing(SolidKind::icosahedron, 0.75, 51);
    Packing packing = start;
    PackingEnergy energy;
    MinimiseOptions limited = options();
    limited.max_evaluations = budget;
    const MinimiseSummary summary = minimise(packing, energy, limited);
    EXPECT_EQ(summary.reason, StopReason::budget) << budget << ": " << to_string(summary.reason);
    EXPECT_GE(summary.evaluations, budget);
    EXPECT_LT(summary.evaluations, budget + 20);
    EXPECT_FALSE(is_equilibrium(summary));
    const double before = PackingEnergy().evaluate(start).energy;
    EXPECT_EQ(PackingEnergy().evaluate(packing).energy, summary.energy);
    if (budget == 1) {
      EXPECT_TRUE(same_bits(start, packing));
    } else if (summary.iterations > 0) {
      EXPECT_LT(summary.energy, before);
    }
    if (budget == 30) {
      EXPECT_GT(summary.iterations, 0);
    }
  }
}

TEST_P(StopReasonOf, UnjammedAtLowDensity) {
  for (const SolidKind kind : all_solids) {
    Packing packing = small_packing(kind, 0.3, 52);
    const long before = PackingEnergy().evaluate(packing).contacts;
    PackingEnergy energy;
    const MinimiseOptions all = options();
    const MinimiseSummary summary = minimise(packing, energy, all);
    std::printf("%s: %ld contacts before, E/N %.1e after %ld evaluations\n", to_string(kind).data(), before,
                summary.energy / packing.size(), summary.evaluations);
    EXPECT_GT(before, 0);
    EXPECT_EQ(summary.reason, StopReason::unjammed) << to_string(kind) << ": " << to_string(summary.reason);
    EXPECT_FALSE(is_equilibrium(summary));
    EXPECT_LT(summary.energy, all.unjammed_energy * packing.size());
    EXPECT_LT(balance_of(packing).energy, all.unjammed_energy * packing.size());
  }
}

TEST_P(StopReasonOf, NotFinite) {
  Packing packing = small_packing(SolidKind::octahedron, 0.7, 54);
  packing.poses[5].orientation.x() = std::numeric_limits<double>::quiet_NaN();
  const Packing start = packing;
  PackingEnergy energy;
  const MinimiseSummary summary = minimise(packing, energy, options());
  EXPECT_EQ(summary.reason, StopReason::not_finite) << to_string(summary.reason);
  EXPECT_FALSE(is_equilibrium(summary));
  for (std::size_t i = 0; i < start.poses.size(); ++i) {
    EXPECT_EQ(start.poses[i].position, packing.poses[i].position) << "particle " << i;
    if (i == 5) continue;
    EXPECT_EQ(start.poses[i].orientation.coeffs(), packing.poses[i].orientation.coeffs()) << "particle " << i;
  }
}

TEST_P(StopReasonOf, Interrupted) {
  const Packing start = small_packing(SolidKind::dodecahedron, 0.75, 55);
  Packing packing = start;
  PackingEnergy energy;
  std::stop_source source;
  source.request_stop();
  const MinimiseSummary summary = minimise(packing, energy, options(), source.get_token());
  EXPECT_EQ(summary.reason, StopReason::interrupted) << to_string(summary.reason);
  EXPECT_TRUE(same_bits(start, packing));
  EXPECT_EQ(summary.evaluations, 1);
  EXPECT_EQ(summary.energy, PackingEnergy().evaluate(start).energy);
}

TEST(StopReasonTest, EnergyChangeIsThePapersRule) {
  const Packing start = small_packing(SolidKind::octahedron, 0.75, 56);
  MinimiseOptions options;
  options.method = Method::conjugate_gradient;
  options.residual = 0;
  std::vector<MinimiseSummary> summaries;
  for (const double change : {1e-6, 1e-12}) {
    Packing packing = start;
    PackingEnergy energy;
    options.energy_change = change;
    summaries.push_back(minimise(packing, energy, options));
    const MinimiseSummary& summary = summaries.back();
    std::printf("relative change %.0e: residual %.1e after %ld evaluations\n", change, summary.residual,
                summary.evaluations);
    EXPECT_EQ(summary.reason, StopReason::energy_change) << to_string(summary.reason);
    EXPECT_FALSE(is_equilibrium(summary));
    EXPECT_GT(summary.residual, summary.residual_floor);
  }
  EXPECT_LT(summaries[0].evaluations, summaries[1].evaluations);
  EXPECT_GT(summaries[0].energy, summaries[1].energy);
  // The rule uses relative changes, so the energy could still decrease by a multiple of the last change.
  MinimiseOptions exact;
  exact.residual = 1e-8;
  Packing packing = start;
  PackingEnergy energy;
  minimise(packing, energy, options);
  const double stopped = PackingEnergy().evaluate(packing).energy;
  const MinimiseSummary minimum = minimise(packing, energy, exact);
  ASSERT_TRUE(is_equilibrium(minimum)) << to_string(minimum.reason);
  EXPECT_LT((stopped - minimum.energy) / minimum.energy, 1e-6);
}

}  // namespace
}  // namespace isojam
