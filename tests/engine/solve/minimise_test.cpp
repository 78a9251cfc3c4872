#include "engine/solve/minimise/minimise.hpp"

#include <oneapi/tbb/global_control.h>

#include <limits>
#include <tuple>

#include "tests/engine/solve/solve_support.hpp"

namespace isojam {
namespace {

constexpr std::array methods{Method::conjugate_gradient, Method::fire, Method::lbfgs, Method::newton};

class MinimiseWith : public testing::TestWithParam<std::tuple<Method, SolidKind>> {};

INSTANTIATE_TEST_SUITE_P(Methods, MinimiseWith,
                         testing::Combine(testing::ValuesIn(methods), testing::ValuesIn(all_solids)),
                         [](const auto& test) {
                           return std::string(to_string(std::get<0>(test.param))) + "_" +
                                  std::string(to_string(std::get<1>(test.param)));
                         });

void expect_agreement(const MinimiseSummary& summary, const Packing& packing, const Packing& start) {
  const Evaluation fresh = PackingEnergy().evaluate(packing);
  EXPECT_EQ(summary.energy, fresh.energy);
  EXPECT_EQ(summary.residual, fresh.residual);
  EXPECT_EQ(summary.residual_floor, fresh.residual_floor);
  EXPECT_LT(summary.energy, PackingEnergy().evaluate(start).energy);
  EXPECT_EQ(packing.cell.side(), start.cell.side());
  EXPECT_TRUE(packing.solids == start.solids);
  for (const Pose& pose : packing.poses)
    EXPECT_NEAR(pose.orientation.norm(), 1, 4 * std::numeric_limits<double>::epsilon());
}

TEST_P(MinimiseWith, ReachesTheRequestedResidual) {
  const auto [method, kind] = GetParam();
  const Packing start = small_packing(kind, over_compressed(kind), 41);
  Packing packing = start;
  PackingEnergy energy;
  MinimiseOptions options;
  options.method = method;
  // Conjugate gradients converge slowly: each power of ten takes hundreds of evaluations. FIRE sets all velocities to
  // zero whenever a contact opens or closes.
  if (method == Method::conjugate_gradient) options.residual = 1e-4;
  if (method == Method::fire) options.residual = 0.2;
  const MinimiseSummary summary = minimise(packing, energy, options);
  std::printf("N = %d: %s, residual %.1e, E/N %.1e, %ld evaluations, %ld iterations\n", packing.size(),
              to_string(summary.reason).data(), summary.residual, summary.energy / packing.size(), summary.evaluations,
              summary.iterations);
  EXPECT_EQ(summary.reason, StopReason::residual_reached) << to_string(summary.reason);
  EXPECT_TRUE(summary.converged());
  EXPECT_LE(summary.residual, options.residual);
  expect_agreement(summary, packing, start);

  const Balance balance = balance_of(packing);
  const double rounding = 64 * std::numeric_limits<double>::epsilon();
  EXPECT_LE(balance.residual, options.residual * (1 + 1e-3)) << "out of balance by the definition";
  EXPECT_NEAR(balance.energy, summary.energy, rounding * summary.energy);
  EXPECT_GT(balance.contacts, 3 * packing.size() / 2) << "fewer contacts than any rigid packing has";

  EXPECT_GT(summary.iterations, 0);
  EXPECT_LT(summary.iterations, summary.evaluations);
  // Hessians use the overlaps of the last evaluation.
  EXPECT_EQ(energy.evaluations(), summary.evaluations);
}

TEST(Minimise, AnyNumberOfThreadsGivesTheSameBits) {
  for (const Method method : methods) {
    RandomStream random{42};
    const Packing start = random_packing(platonic(SolidKind::dodecahedron), 100, 0.75, random);
    MinimiseOptions options;
    options.method = method;
    options.max_evaluations = 60;
    std::vector<Packing> ends;
    std::vector<MinimiseSummary> summaries;
    for (const std::size_t threads : {1U, 2U}) {
      const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
      Packing packing = start;
      PackingEnergy energy;
      summaries.push_back(minimise(packing, energy, options));
      ASSERT_GT(energy.counts().listed, 256 * energy.evaluations()) << "too few pairs for a second thread to help";
      ends.push_back(packing);
    }
    EXPECT_TRUE(same_bits(ends[0], ends[1])) << to_string(method);
    EXPECT_FALSE(same_bits(start, ends[0])) << to_string(method);
    EXPECT_EQ(summaries[0].energy, summaries[1].energy) << to_string(method);
    EXPECT_EQ(summaries[0].residual, summaries[1].residual) << to_string(method);
    EXPECT_EQ(summaries[0].evaluations, summaries[1].evaluations) << to_string(method);
  }
}

/// An equilibrium of octahedra that was decompressed from φ = 0.75 towards jamming and then strained once more.
Packing expanded_octahedra() {
  Packing packing = small_packing(SolidKind::octahedron, 0.75, 43, 40);
  PackingEnergy energy;
  MinimiseOptions options;
  options.residual = 1e-8;
  for (const double density : {0.75, 0.735, 0.725}) {
    packing = strained_to(packing, density);
    const MinimiseSummary summary = minimise(packing, energy, options);
    EXPECT_TRUE(is_equilibrium(summary)) << "at " << density << ": " << to_string(summary.reason);
  }
  return strained_to(packing, 0.715);
}

TEST(Minimise, NewtonConvergesWhereConjugateGradientsDoNot) {
  const Packing start = expanded_octahedra();
  PackingEnergy energy;
  MinimiseOptions options;
  options.residual = 1e-8;
  Packing by_newton = start, by_gradients = start;
  const MinimiseSummary newton = minimise(by_newton, energy, options);
  ASSERT_TRUE(newton.converged()) << to_string(newton.reason) << " residual " << newton.residual;
  EXPECT_LE(balance_of(by_newton).residual, 1.1e-8);

  options.method = Method::conjugate_gradient;
  options.max_evaluations = 10 * newton.evaluations;
  const MinimiseSummary gradients = minimise(by_gradients, energy, options);
  std::printf("E/N %.1e: Newton %ld evaluations to %.1e, conjugate gradients %ld to %.1e\n",
              newton.energy / start.size(), newton.evaluations, newton.residual, gradients.evaluations,
              gradients.residual);
  EXPECT_EQ(gradients.reason, StopReason::budget) << to_string(gradients.reason);
  EXPECT_GT(gradients.residual, 1e-8);
  EXPECT_GT(gradients.energy, newton.energy * (1 - 1e-6));
}

}  // namespace
}  // namespace isojam
