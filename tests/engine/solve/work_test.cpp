#include <gtest/gtest.h>

#include "engine/packing/neighbours.hpp"
#include "engine/solve/jam.hpp"
#include "engine/solve/minimise/step_model.hpp"
#include "engine/vibration/spectrum.hpp"
#include "tests/engine/solve/solve_support.hpp"

namespace isojam {
namespace {

const JamResult& expanded() {
  static const JamResult result = [] {
    JamOptions options;
    options.compression.initial_density = 0.2;
    options.decompression.final_distance = 0.01;
    options.minimise.residual = 1e-9;
    options.minimise.method = Method::newton;
    return jam(small_packing(SolidKind::octahedron, options.compression.initial_density, 1, 45), options);
  }();
  return result;
}

void print(const char* what, const MinimiseSummary& summary) {
  std::printf("%s: %s, %ld evaluations (%ld in double-double), %ld Hessians, %ld factorisations, %ld updates\n", what,
              to_string(summary.reason).data(), summary.evaluations, summary.work.double_double_evaluations,
              summary.work.hessians, summary.work.factorisations, summary.work.factor_updates);
}

MinimiseSummary minimised(Method method, Packing packing, double residual) {
  PackingEnergy energy;
  MinimiseOptions options;
  options.method = method;
  options.residual = residual;
  options.max_evaluations = 200;
  const MinimiseSummary summary = minimise(packing, energy, options);
  print(to_string(method).data(), summary);
  return summary;
}

TEST(Work, HessiansAreComputedIfTheMethodNeedsThem) {
  const Packing start = small_packing(SolidKind::octahedron, 0.8, 41, 45);
  for (const auto& [method, hessians] :
       {std::pair{Method::conjugate_gradient, 0L}, {Method::lbfgs, 0L}, {Method::fire, 1L}}) {
    const MinimiseWork work = minimised(method, start, 1e-6).work;
    EXPECT_EQ(work.hessians, hessians) << to_string(method);
    EXPECT_EQ(work.factorisations + work.factor_updates, 0) << to_string(method);
  }
  const MinimiseSummary newton = minimised(Method::newton, start, 1e-6);
  EXPECT_TRUE(newton.converged());
  EXPECT_GE(newton.work.hessians, newton.iterations) << "each step starts from a Hessian of its own";
  EXPECT_LT(newton.work.hessians, newton.evaluations) << "the last evaluation needs none";
}

TEST(Work, FactorsAreUpdatedIfThatIsCheaper) {
  const Packing& state = expanded().states.back();
  const MinimiseSummary summary = minimised(Method::newton, strained_to(state, state.density() - 0.002), 1e-9);
  const MinimiseWork& work = summary.work;
  EXPECT_TRUE(is_equilibrium(summary));
  EXPECT_GT(work.factor_updates, 0);
  EXPECT_GE(work.factorisations, summary.iterations);
  EXPECT_LE(work.factorisations + work.factor_updates, StepModel::most_rounds * summary.evaluations);
  EXPECT_GT(10 * work.factor_updates, work.factorisations) << "hardly anything is ever updated";
}

TEST(Work, DoubleDoubleIsUsedOnlyAtTheFloor) {
  const Packing start = small_packing(SolidKind::octahedron, 0.9, 41, 45);
  const MinimiseSummary far = minimised(Method::newton, start, 1e-6);
  EXPECT_TRUE(far.converged());
  EXPECT_LT(far.residual_floor, 1e-6);
  EXPECT_EQ(far.work.double_double_evaluations, 0);
  EXPECT_EQ(far.precision, Precision::working);
  const MinimiseSummary beyond = minimised(Method::newton, start, far.residual_floor / 10);
  EXPECT_GT(beyond.work.double_double_evaluations, 0);
  EXPECT_LT(beyond.work.double_double_evaluations, beyond.evaluations) << "most of the way is made in doubles";
}

TEST(Work, OverlapIsNotCalledForSeparatedPairs) {
  for (const SolidKind kind : all_solids) {
    const Packing packing = small_packing(kind, 0.6, 5, 60);
    PackingEnergy energy;
    energy.evaluate(packing);
    const PairCounts cold = energy.counts();
    energy.evaluate(packing);
    PairCounts warm = energy.counts();
    const long overlapped = warm.overlapped - cold.overlapped;
    std::printf("%s: %ld listed, %ld out of reach, to the kernel %ld cold, %ld warm, %ld touching\n",
                to_string(kind).data(), cold.listed, cold.out_of_reach, cold.overlapped, overlapped, cold.touching);
    EXPECT_GT(cold.overlapped, cold.touching) << "nothing to be spared";
    EXPECT_EQ(overlapped, cold.touching);
    const double reach = 2 * packing.solids.only().circumradius();
    const auto near = static_cast<long>(find_neighbours_brute_force(packing, reach).size());
    EXPECT_EQ(cold.listed - cold.out_of_reach, near);
    EXPECT_LT(cold.out_of_reach, near / 2) << "the list's skin is as thick as what it covers";
  }
}

}  // namespace
}  // namespace isojam
