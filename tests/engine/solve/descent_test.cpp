// The states range from random to converged ones, in which the energy change of a step is below the rounding error.

#include "engine/solve/minimise/descent.hpp"

#include <limits>

#include "tests/engine/solve/solve_support.hpp"

namespace isojam {
namespace {

class DescentOf : public testing::TestWithParam<SolidKind> {};

INSTANTIATE_TEST_SUITE_P(Solids, DescentOf, testing::ValuesIn(all_solids),
                         [](const auto& test) { return std::string(to_string(test.param)); });

/// Largest difference between the positions of `after` and the positions of `before` moved by `step`.
double misplaced(const Packing& before, const Packing& after, const Eigen::VectorXd& step) {
  double worst = 0;
  const Packing expected = moved(before, step);
  for (std::size_t i = 0; i < before.poses.size(); ++i)
    worst = std::max(worst, (after.poses[i].position - expected.poses[i].position).norm());
  return worst;
}

/// Takes steps along random descent directions. Returns the number of steps whose energy change is below the rounding
/// error.
int wander(Packing& packing, int steps, RandomStream& random) {
  PackingEnergy energy;
  MinimiseOptions options;
  options.residual = 0;
  Descent descent(packing, energy, options, {});
  int unresolved = 0;
  for (int k = 0; k < steps; ++k) {
    const Packing before = packing;
    const Evaluation here = descent.here();
    const double length = here.gradient.norm();
    if (length == 0) break;
    const Eigen::VectorXd noise = normal_vector(here.gradient.size(), random);
    Eigen::VectorXd direction = -here.gradient + 0.5 * length / noise.norm() * noise;
    const double guess = decade(random, -6, 0) * descent.longest_displacement() / largest_displacement(direction);
    const double scale = packing.cell.side() * std::numeric_limits<double>::epsilon();
    if (!descent.advance(direction, guess, 0.1)) {
      EXPECT_TRUE(same_bits(before, packing)) << "moved although nothing was found";
      continue;
    }
    const double moved_by = descent.last_step() * largest_displacement(direction);
    EXPECT_GT(descent.last_step(), 0) << "step " << k;
    EXPECT_LE(moved_by, descent.longest_displacement() * (1 + 1e-12)) << "step " << k;
    EXPECT_LE(misplaced(before, packing, descent.last_step() * direction), 8 * scale) << "step " << k;
    EXPECT_LE(descent.here().energy, here.energy + here.energy_noise) << "step " << k;
    EXPECT_EQ(descent.here().energy, PackingEnergy().evaluate(packing).energy) << "step " << k;
    unresolved += here.energy - descent.here().energy < here.energy_noise;
  }
  return unresolved;
}

TEST(Descent, TakesTheStepItReports) {
  int unresolved = 0;
  for (const SolidKind kind : all_solids) {
    SCOPED_TRACE(to_string(kind));
    RandomStream random{31};
    Packing packing = small_packing(kind, over_compressed(kind), 32);
    wander(packing, 40, random);
    MinimiseOptions options;
    options.residual = 1e-7;
    PackingEnergy energy;
    minimise(packing, energy, options);
    unresolved += wander(packing, 100, random);
  }
  std::printf("%d steps below the noise of the energy\n", unresolved);
  EXPECT_GT(unresolved, 0);
}

TEST_P(DescentOf, JudgesRelativeChangesOfEnergy) {
  int settled = 0, moving = 0;
  for (const double tolerance : {1e-1, 1e-2, 1e-3}) {
    Packing packing = small_packing(GetParam(), over_compressed(GetParam()), 34);
    PackingEnergy energy;
    MinimiseOptions options;
    options.residual = 0;
    options.energy_change = tolerance;
    Descent descent(packing, energy, options, {});
    EXPECT_FALSE(descent.verdict()) << "nothing has changed yet";
    for (int k = 0; k < 60; ++k) {
      const double before = descent.here().energy;
      const Eigen::VectorXd direction = -descent.here().gradient;
      ASSERT_TRUE(descent.advance(direction, 1e-3 / largest_displacement(direction), 0.1));
      const double change = (before - descent.here().energy) / descent.here().energy;
      const bool stops = descent.verdict() == StopReason::energy_change;
      EXPECT_EQ(stops, change < tolerance) << "relative change " << change << ", tolerance " << tolerance;
      ++(stops ? settled : moving);
    }
  }
  EXPECT_GT(settled, 10);
  EXPECT_GT(moving, 10);
}

TEST_P(DescentOf, RejectsUphillDirections) {
  Packing packing = small_packing(GetParam(), over_compressed(GetParam()), 33);
  const Packing before = packing;
  PackingEnergy energy;
  const MinimiseOptions options;
  Descent descent(packing, energy, options, {});
  const Eigen::VectorXd uphill = descent.here().gradient;
  EXPECT_FALSE(descent.advance(uphill, 1, 0.1));
  EXPECT_FALSE(descent.advance(Eigen::VectorXd::Zero(uphill.size()), 1, 0.1));
  EXPECT_TRUE(same_bits(before, packing));
  EXPECT_EQ(descent.evaluations(), 1);
}

}  // namespace
}  // namespace isojam
