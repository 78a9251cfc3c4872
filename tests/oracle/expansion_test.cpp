// Whole replicates with N = 100, decompressed to Δφ ≤ 0.004 (0.01 for tetrahedra). Reference: residuals in quadruple
// precision; prints a table of them.

#include <gtest/gtest.h>

#include <cstdio>

#include "engine/solve/jam.hpp"
#include "tests/oracle/quad_packing.hpp"

namespace isojam::oracle {
namespace {

class Expansion : public testing::TestWithParam<SolidKind> {};
INSTANTIATE_TEST_SUITE_P(Solids, Expansion,
                         testing::Values(SolidKind::tetrahedron, SolidKind::octahedron, SolidKind::dodecahedron,
                                         SolidKind::icosahedron),
                         [](const auto& name) { return std::string(to_string(name.param)); });

TEST_P(Expansion, EveryStateIsAnEquilibriumInQuadruplePrecision) {
  constexpr double asked = 1e-9;
  RandomStream random{83, static_cast<std::uint64_t>(GetParam())};
  JamOptions options;
  options.minimise.residual = asked;
  options.decompression.final_distance = GetParam() == SolidKind::tetrahedron ? .01 : .004;
  const JamResult result =
      jam(random_packing(platonic(GetParam()), 100, options.compression.initial_density, random), options);
  ASSERT_EQ(result.status, JamStatus::jammed) << to_string(result.status);
  std::printf("%s: phi_J %.4f\n", std::string(to_string(GetParam())).c_str(), result.phi_j->density);
  for (std::size_t k = 0; k < result.states.size(); ++k) {
    const JamStep& step = result.path[static_cast<std::size_t>(result.state_steps[k])];
    const double residual = static_cast<double>(evaluate_in_quad(result.states[k]).residual);
    std::printf(
        "  delta_phi %.4f  E/N %.1e  residual %.1e, in quadruple precision %.1e  (%s, floor %.1e, %ld evaluations)\n",
        step.density - result.phi_j->density, step.energy_per_particle, step.summary.residual, residual,
        std::string(to_string(step.summary.reason)).c_str(), step.summary.residual_floor,
        static_cast<long>(step.summary.evaluations));
    EXPECT_LE(residual, asked + step.summary.residual_floor) << "at density " << step.density;
    EXPECT_EQ(step.summary.reason, StopReason::residual_reached) << to_string(step.summary.reason);
  }
}

}  // namespace
}  // namespace isojam::oracle
