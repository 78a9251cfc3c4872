#include "engine/packing/enthalpy.hpp"
#include "engine/solve/jam.hpp"
#include "tests/engine/solve/jam_support.hpp"
#include "tests/engine/solve/solve_support.hpp"

namespace isojam {
namespace {

const System octahedra{SolidKind::octahedron, 48};

JamOptions cohesive(CohesionUntil until) {
  JamOptions options = lax();
  options.compression.target_energy = 1e-8;
  options.cohesion = Cohesion{0.1, 1e-4};
  options.cohesion_until = until;
  return options;
}

void expect_balance(const Packing& state, const JamOptions& options) {
  const Enthalpy enthalpy(control_at_pressure(options, 0), state.cell);
  PackingEnergy energy(options.cohesion);
  const Evaluation value = enthalpy.of(energy.evaluate(state, Precision::double_double), state);
  const double scale = value.repulsive_pressure.value(), allowed = options.minimise.residual * scale;
  std::printf("%s: φ_0 = %.4f, E/N = %.3e, residual %.1e, pressure %.1e of %.1e, %ld contacts\n",
              to_string(options.cell).data(), state.density(), value.energy / state.size(), value.residual,
              value.pressure, scale, value.contacts);
  EXPECT_LE(value.residual, options.minimise.residual);
  EXPECT_LT(value.energy, 0);
  EXPECT_GT(scale, 0);
  EXPECT_LE(std::abs(value.pressure), allowed);
  if (options.cell == CellShape::free) {
    EXPECT_LE(value.stress.cwiseAbs().maxCoeff(), allowed);
  }
  EXPECT_GT(value.contacts, 2 * state.size());
}

TEST(CohesiveJam, FindsEquilibriaAtZeroPressure) {
  JamOptions options = cohesive(CohesionUntil::end);
  const JamResult cubic = jam(start_of(octahedra, 7, options), options);
  ASSERT_EQ(cubic.status, JamStatus::zero_pressure);
  ASSERT_EQ(cubic.states.size(), 1U);
  EXPECT_FALSE(cubic.phi_j);
  expect_balance(cubic.states.front(), options);
  options.cell = CellShape::free;
  const JamResult sheared = jam(begin_decompression(cubic.states.front(), options), options);
  ASSERT_EQ(sheared.status, JamStatus::zero_pressure);
  expect_balance(sheared.states.front(), options);
  EXPECT_LT(sheared.path.back().energy_per_particle, cubic.path.back().energy_per_particle);
}

TEST(CohesiveJam, DecompressesWithoutCohesion) {
  const JamOptions options = cohesive(CohesionUntil::decompression);
  const JamResult result = jam(start_of(octahedra, 7, options), options);
  ASSERT_EQ(result.status, JamStatus::jammed);
  ASSERT_TRUE(result.phi_j);
  EXPECT_LT(result.path.front().energy_per_particle, 0);
  for (const Packing& state : result.states)
    EXPECT_LE(PackingEnergy().evaluate(state, Precision::double_double).residual, options.minimise.residual);
}

TEST(CohesiveJam, ContinuesFromAnyProgress) {
  const JamOptions options = cohesive(CohesionUntil::end);
  std::vector<JamProgress> saved;
  const JamResult whole =
      jam(start_of(octahedra, 8, options), options, {}, [&](const JamProgress& at) { saved.push_back(at); });
  ASSERT_GT(saved.size(), 4U);
  for (const std::size_t k : {std::size_t{1}, saved.size() / 2, saved.size() - 2}) {
    const JamResult rest = jam(saved[k], options);
    ASSERT_EQ(rest.states.size(), 1U);
    EXPECT_EQ(rest.states.front().poses, whole.states.front().poses) << k;
    EXPECT_EQ(rest.evaluations, whole.evaluations) << k;
  }
}

TEST(CohesiveJam, EndsIfTheCellIsTooSmall) {
  JamOptions options = cohesive(CohesionUntil::end);
  options.cohesion.range = 0.8;
  EXPECT_EQ(jam(start_of(octahedra, 7, options), options).status, JamStatus::cell_limit);
}

TEST(CohesiveJam, NamesDetachedPackings) {
  JamOptions options = cohesive(CohesionUntil::end);
  options.compression.initial_density = 0.0005;
  options.cohesion.range = 1e-6;
  Packing apart = start_of(octahedra, 9, options);
  ASSERT_EQ(PackingEnergy().evaluate(apart).contacts, 0);
  JamProgress progress = begin_decompression(std::move(apart), options);
  EXPECT_EQ(jam(std::move(progress), options).status, JamStatus::detached);
}

}  // namespace
}  // namespace isojam
