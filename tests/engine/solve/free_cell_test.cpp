#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <map>
#include <tuple>

#include "engine/packing/enthalpy.hpp"
#include "engine/solve/jam.hpp"
#include "engine/solve/multipliers/multipliers.hpp"
#include "engine/solve/rearrangement.hpp"

namespace isojam {
namespace {

Packing start_of(SolidKind kind, int n) {
  // With 91, icosahedra crystallise.
  RandomStream random{kind == SolidKind::icosahedron ? 92U : 91U, static_cast<std::uint64_t>(kind)};
  return random_packing(platonic(kind), n, .3, random);
}

JamOptions options_of(Control control, CellShape cell) {
  JamOptions options;
  options.compression.initial_density = .3;
  options.compression.step = .04;
  options.compression.evaluations = 300;
  options.compression.target_energy = 1e-5;
  options.decompression.final_distance = .02;
  options.decompression.control = control;
  options.cell = cell;
  return options;
}

struct System {
  SolidKind kind;
  int n;
};

const JamResult& jammed(const System& system, Control control, CellShape cell) {
  static std::map<std::tuple<SolidKind, Control, CellShape>, JamResult> made;
  const auto [place, is_new] = made.try_emplace({system.kind, control, cell});
  if (is_new) place->second = jam(start_of(system.kind, system.n), options_of(control, cell));
  return place->second;
}

const JamStep& step_of(const JamResult& result, std::size_t k) {
  return result.path[static_cast<std::size_t>(result.state_steps[k])];
}

class FreeCell : public testing::TestWithParam<System> {};

INSTANTIATE_TEST_SUITE_P(Solids, FreeCell,
                         testing::Values(System{SolidKind::tetrahedron, 110}, System{SolidKind::octahedron, 64},
                                         System{SolidKind::dodecahedron, 40}, System{SolidKind::icosahedron, 40}),
                         [](const auto& test) { return std::string(to_string(test.param.kind)); });

TEST_P(FreeCell, StressIsHydrostaticAtEveryPressure) {
  const JamResult& result = jammed(GetParam(), Control::pressure, CellShape::free);
  ASSERT_EQ(result.status, JamStatus::jammed);
  for (std::size_t k = 0; k < result.states.size(); ++k) {
    const JamStep& step = step_of(result, k);
    std::printf("phi %.4f, p %.3e, deviator %.1e, residual %.1e\n", step.density, step.pressure, step.deviator,
                step.summary.residual);
    EXPECT_TRUE(is_equilibrium(step.summary)) << k;
    EXPECT_LE(step.deviator, 1e-6) << k;
    EXPECT_FALSE(result.states[k].cell.is_cube());
    if (k == 0) continue;
    EXPECT_LT(step.pressure, step_of(result, k - 1).pressure);
  }
  const JamStep& nearest = step_of(result, result.states.size() - 1);
  EXPECT_NEAR(nearest.density - distance_to_jamming(nearest), result.phi_j->density, .002);
  // A cube keeps stresses that are not hydrostatic.
  const JamResult& cube = jammed(GetParam(), Control::density, CellShape::isotropic);
  EXPECT_GE(step_of(cube, cube.states.size() - 1).deviator, .005);
}

TEST_P(FreeCell, IsHydrostaticAtGivenDensityToo) {
  const JamResult& result = jammed(GetParam(), Control::density, CellShape::free);
  ASSERT_EQ(result.status, JamStatus::jammed);
  for (std::size_t k = 0; k < result.states.size(); ++k) {
    EXPECT_LE(step_of(result, k).deviator, 1e-6) << k;
    EXPECT_NEAR(result.states[k].density(), step_of(result, k).density, 1e-13);
    EXPECT_FALSE(result.states[k].cell.is_cube());
  }
}

TEST_P(FreeCell, TheIsotropicPressurePathIsTheDensityPath) {
  const JamResult& by_pressure = jammed(GetParam(), Control::pressure, CellShape::isotropic);
  const JamResult& by_density = jammed(GetParam(), Control::density, CellShape::isotropic);
  ASSERT_EQ(by_pressure.status, JamStatus::jammed);
  // Both begin with the same state, to the last bit.
  EXPECT_EQ(step_of(by_pressure, 0).energy_per_particle, step_of(by_density, 0).energy_per_particle);
  int same = 0;
  for (std::size_t k = 1; k < by_pressure.states.size(); ++k) {
    const Packing& goal = by_pressure.states[k];
    EXPECT_TRUE(goal.cell.is_cube()) << k;
    // From the previous state to this density, as with density control.
    Packing packing = by_pressure.states[k - 1];
    PackingEnergy energy;
    const JamOptions options = options_of(Control::density, CellShape::isotropic);
    const MinimiseSummary summary = follow_equilibrium(
        packing, goal.density(), distance_to_jamming(step_of(by_pressure, k - 1)), energy, options.minimise);
    ASSERT_TRUE(is_equilibrium(summary)) << k;
    const double there = energy.evaluate(packing, Precision::double_double).energy;
    const double here = energy.evaluate(goal, Precision::double_double).energy;
    std::printf("phi %.6f: E %.9e by pressure, %.9e by density\n", goal.density(), here, there);
    same += std::abs(there - here) <= 1e-6 * here;
  }
  // After a rearrangement, the two paths can be on different solution branches.
  EXPECT_GE(3 * same, static_cast<int>(by_pressure.states.size()) - 1);
  EXPECT_GE(same, 1);
}

TEST(FreeCellTest, EveryMinimiserFindsTheMinimumOfTheEnthalpy) {
  const System system{SolidKind::dodecahedron, 40};
  const JamResult& result = jammed(system, Control::pressure, CellShape::free);
  PackingEnergy energy;
  for (const CellFreedom cell : {CellFreedom::isotropic, CellFreedom::shape, CellFreedom::free}) {
    double lowest = 0;
    for (const Method method : {Method::newton, Method::lbfgs, Method::conjugate_gradient, Method::fire}) {
      Packing packing = result.states.front();
      MinimiseOptions options;
      options.method = method;
      options.residual = 1e-5;
      options.max_evaluations = 60000;
      // Slightly below the pressure of the state, so that everything moves.
      options.control = {cell, .97 * step_of(result, 0).pressure};
      const Enthalpy enthalpy(options.control, packing.cell);
      const MinimiseSummary summary = minimise(packing, energy, options);
      const Evaluation there = enthalpy.of(energy.evaluate(packing), packing);
      std::printf("%s, %s: H %.10e, residual %.1e, %ld evaluations\n", to_string(cell).data(), to_string(method).data(),
                  there.energy, there.residual, summary.evaluations);
      EXPECT_TRUE(is_equilibrium(summary)) << to_string(method) << ", " << to_string(cell);
      if (method == Method::newton) lowest = there.energy;
      EXPECT_NEAR(there.energy, lowest, 1e-8 * std::abs(there.energy) + 1e-9 * there.energy_noise);
      const double pressure = frees_volume(cell) ? options.control.pressure : there.pressure;
      EXPECT_NEAR(there.pressure, pressure, 2e-5 * pressure);
      EXPECT_LE(cell == CellFreedom::isotropic ? 0 : deviator_of(there), 3e-5);
    }
  }
}

TEST(FreeCellTest, ContinuesFromAnyStepWithTheSameBits) {
  JamOptions options = options_of(Control::pressure, CellShape::free);
  options.decompression.final_distance = .05;
  std::vector<JamProgress> steps;
  const JamResult whole = jam(start_of(SolidKind::octahedron, 64), options, {},
                              [&](const JamProgress& progress) { steps.push_back(progress); });
  ASSERT_GE(steps.size(), 6U);
  for (std::size_t k : {std::size_t{1}, steps.size() / 2, steps.size() - 2}) {
    const JamResult again = jam(steps[k], options);
    ASSERT_EQ(again.path.size(), whole.path.size());
    EXPECT_EQ(again.path.back().energy_per_particle, whole.path.back().energy_per_particle);
    EXPECT_EQ(again.phi_j->density, whole.phi_j->density);
    EXPECT_TRUE(again.states.back().poses == whole.states.back().poses);
    EXPECT_TRUE(again.states.back().cell == whole.states.back().cell);
  }
}

TEST(FreeCellTest, ACellThatBecomesTooSmallEndsTheRunWithThatReason) {
  // With so few particles, the cube at the requested pressure would be smaller than the solids allow.
  Packing packing = start_of(SolidKind::icosahedron, 12);
  MinimiseOptions options;
  options.method = Method::lbfgs;
  options.control = {CellFreedom::free, 1};
  PackingEnergy energy;
  const MinimiseSummary summary = minimise(packing, energy, options);
  EXPECT_EQ(summary.reason, StopReason::cell_limit);
  EXPECT_TRUE(is_legal(packing.cell, packing.solids.only()));
  EXPECT_TRUE(std::isfinite(summary.energy) && std::isfinite(summary.residual));
}

}  // namespace
}  // namespace isojam
