#include "engine/vibration/settle.hpp"

#include <gtest/gtest.h>

#include "engine/vibration/relax_to_minimum.hpp"
#include "tests/engine/vibration/jammed_states.hpp"
#include "tests/engine/vibration/saddle.hpp"

namespace isojam {
namespace {

TEST(Settle, RelaxesSaddlesAndKeepsMinima) {
  JamOptions options;
  options.minimise.residual = 1e-8;
  JamResult result = jammed(SolidKind::octahedron, 48, .01);
  const JamResult before = result;

  MinimumSearchOptions none;
  none.minimise = options.minimise;
  none.max_descents = 0;
  const MinimumSearchResult saddle = relax_to_minimum(lattice(SolidKind::octahedron, 4, 0.95, 0), none);
  ASSERT_EQ(saddle.ended, MinimumSearchEnd::still_unstable);
  // The nearest state is replaced by the saddle, at a density that is outside of the fit.
  JamStep& step = result.path[static_cast<std::size_t>(result.state_steps.back())];
  step.density = saddle.packing.density();
  step.energy_per_particle = saddle.summary.energy / saddle.packing.size();
  step.summary = saddle.summary;
  result.states.back() = saddle.packing;
  const double energy_of_saddle = step.energy_per_particle;

  settle(result, options);
  EXPECT_GE(step.descents, 1);
  EXPECT_LT(step.energy_per_particle, energy_of_saddle);
  EXPECT_EQ(result.states.back().density(), saddle.packing.density());
  const Evaluation there = PackingEnergy().evaluate(result.states.back(), step.summary.precision);
  EXPECT_EQ(step.energy_per_particle, there.energy / result.states.back().size());
  EXPECT_EQ(step.pressure, there.pressure);
  EXPECT_EQ(relax_to_minimum(result.states.back(), none).ended, MinimumSearchEnd::was_minimum);
  for (std::size_t k = 0; k + 1 < result.states.size(); ++k) {
    EXPECT_TRUE(same_bits(result.states[k], before.states[k])) << "state " << k;
    EXPECT_EQ(result.path[static_cast<std::size_t>(result.state_steps[k])].descents, 0) << "state " << k;
  }
  const auto fitted = fit_jamming_point(energy_points(result), options.decompression.fit_window);
  ASSERT_TRUE(result.phi_j && fitted);
  EXPECT_EQ(result.phi_j->density, fitted->density);
  EXPECT_NE(result.phi_j->density, before.phi_j->density);
}

TEST(Settle, ChangesNothingIfAllAreMinima) {
  JamResult result = jammed(SolidKind::octahedron, 48, .01);
  const double density = result.phi_j->density;
  settle(result, {});
  EXPECT_EQ(result.phi_j->density, density);
  for (std::size_t k = 0; k < result.states.size(); ++k)
    EXPECT_TRUE(same_bits(result.states[k], jammed(SolidKind::octahedron, 48, .01).states[k])) << "state " << k;
}

}  // namespace
}  // namespace isojam
