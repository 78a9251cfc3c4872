#include "engine/solve/jam.hpp"

#include "tests/engine/solve/jam_support.hpp"
#include "tests/engine/solve/solve_support.hpp"

namespace isojam {
namespace {

class Jam : public testing::TestWithParam<System> {};

INSTANTIATE_TEST_SUITE_P(Systems, Jam,
                         testing::Values(System{SolidKind::dodecahedron, 24}, System{SolidKind::octahedron, 48}),
                         [](const auto& test) { return std::string(to_string(test.param.kind)); });

void expect_path(const JamResult& result, const JamOptions& options) {
  bool expanding = false, aimed = false;
  const JamStep* before = nullptr;
  for (const JamStep& step : result.path) {
    if (step.stage == JamStage::compression) {
      EXPECT_FALSE(expanding) << "compression after decompression";
      if (before) {
        const double strain = aimed_strain(options.compression, *before);
        EXPECT_NEAR(step.density, before->density + strain, 1e-12);
        aimed |= strain < options.compression.step;
      }
    } else if (!expanding) {
      expanding = true;
      EXPECT_EQ(step.density, before->density) << "the state at the target is minimised once more, fully";
    }
    before = &step;
    EXPECT_NE(step.summary.reason, StopReason::not_called);
  }
  ASSERT_TRUE(expanding);
  EXPECT_TRUE(aimed) << "no strain step is shorter";
  const auto last_up = std::find_if(result.path.begin(), result.path.end(),
                                    [](const JamStep& step) { return step.stage == JamStage::decompression; }) -
                       1;
  EXPECT_GE(last_up->energy_per_particle, options.compression.target_energy);
  for (auto step = result.path.begin(); step != last_up; ++step)
    EXPECT_TRUE(step->energy_per_particle < options.compression.target_energy ||
                step->summary.reason == StopReason::unjammed)
        << "went on beyond the target at " << step->density;
}

void expect_states(const JamResult& result, const JamOptions& options) {
  ASSERT_GE(result.states.size(), 3U);
  ASSERT_EQ(result.states.size(), result.state_steps.size());
  for (std::size_t s = 0; s < result.states.size(); ++s) {
    const Packing& state = result.states[s];
    const JamStep& step = result.path[static_cast<std::size_t>(result.state_steps[s])];
    EXPECT_EQ(step.stage, JamStage::decompression);
    EXPECT_TRUE(is_equilibrium(step.summary)) << to_string(step.summary.reason);
    const Evaluation fresh = PackingEnergy().evaluate(state, step.summary.precision);
    EXPECT_EQ(step.density, state.density());
    EXPECT_EQ(step.energy_per_particle, fresh.energy / state.size());
    EXPECT_EQ(step.pressure, fresh.pressure);
    EXPECT_GT(step.pressure, 0);
    const double asked = std::max(options.minimise.residual, step.summary.residual_floor);
    EXPECT_LE(balance_of(state).residual, asked * (1 + 1e-3)) << "state " << s << " is not in balance";
    if (s == 0) continue;
    EXPECT_LT(state.density(), result.states[s - 1].density());
    EXPECT_GT(result.state_steps[s], result.state_steps[s - 1]);
    const JamStep& above = result.path[static_cast<std::size_t>(result.state_steps[s - 1])];
    EXPECT_LT(step.energy_per_particle, above.energy_per_particle);
  }
}

void expect_jamming_point(const JamResult& result, const JamOptions& options) {
  ASSERT_TRUE(result.phi_j);
  const double nearest = result.states.back().density();
  EXPECT_GT(result.phi_j->density, 0.6);
  EXPECT_LT(result.phi_j->density, 0.8);
  EXPECT_LT(result.phi_j->density, nearest);
  EXPECT_LT(result.phi_j->single_state, nearest);
  EXPECT_LE(nearest - result.phi_j->single_state, options.decompression.final_distance * (1 + 1e-12));
  // Two extrapolations over the same distance differ by only a part of this distance.
  EXPECT_NEAR(result.phi_j->density, result.phi_j->single_state, options.decompression.final_distance / 2);
}

TEST_P(Jam, EndsAtTheEdgeOfJamming) {
  const JamOptions options = lax();
  std::vector<JamStep> reported;
  const JamResult result = jam(start_of(GetParam(), 74, options), options, {},
                               [&](const JamProgress& progress) { reported.push_back(progress.result.path.back()); });
  std::printf("%s after %zu steps, %zu states, %ld evaluations, φ_J %.4f ± %.4f, single state %.4f, exponent %.2f\n",
              to_string(result.status).data(), result.path.size(), result.states.size(), result.evaluations,
              result.phi_j ? result.phi_j->density : 0, result.phi_j ? result.phi_j->standard_error : 0,
              result.phi_j ? result.phi_j->single_state : 0, result.phi_j ? result.phi_j->exponent : 0);
  ASSERT_EQ(result.status, JamStatus::jammed) << to_string(result.status);
  expect_path(result, options);
  expect_states(result, options);
  expect_jamming_point(result, options);
  ASSERT_EQ(reported.size(), result.path.size());
  long spent = 0;
  for (std::size_t k = 0; k < reported.size(); ++k) {
    EXPECT_EQ(reported[k].density, result.path[k].density);
    spent += reported[k].summary.evaluations;
  }
  EXPECT_GE(result.evaluations, spent);

  const JamResult again = jam(start_of(GetParam(), 74, options), options);
  ASSERT_EQ(again.states.size(), result.states.size());
  for (std::size_t s = 0; s < result.states.size(); ++s) EXPECT_TRUE(same_bits(result.states[s], again.states[s])) << s;
  EXPECT_EQ(again.phi_j->density, result.phi_j->density);
  EXPECT_EQ(again.evaluations, result.evaluations);
}

TEST(JamTest, StopsOnRequest) {
  const JamOptions options = lax();
  // Interrupted during the compression, and during the decompression when some states exist.
  for (const std::size_t wanted_states : {0U, 2U}) {
    std::stop_source source;
    std::size_t decompression_steps = 0, steps = 0;
    const JamResult result =
        jam(start_of(small, 71, options), options, source.get_token(), [&](const JamProgress& progress) {
          ++steps;
          decompression_steps += progress.result.path.back().stage == JamStage::decompression;
          if (wanted_states == 0 ? steps == 3 : decompression_steps == wanted_states) source.request_stop();
        });
    EXPECT_EQ(result.status, JamStatus::interrupted) << to_string(result.status);
    EXPECT_EQ(result.path.size(), steps) << "went on after the stop";
    EXPECT_EQ(result.states.size(), wanted_states);
    EXPECT_EQ(result.phi_j.has_value(), wanted_states >= 2);
  }
}

TEST(JamTest, ContinuesFromAnyStepWithTheSameBits) {
  const JamOptions options = lax();
  std::vector<JamProgress> along;
  const JamResult whole =
      jam(start_of(small, 71, options), options, {}, [&](const JamProgress& progress) { along.push_back(progress); });
  ASSERT_EQ(along.size(), whole.path.size());
  for (const std::size_t k : {std::size_t{0}, along.size() / 2, along.size() - 4, along.size() - 2, along.size() - 1}) {
    const JamResult rest = jam(along[k], options);
    EXPECT_EQ(rest.status, whole.status) << k;
    EXPECT_EQ(rest.evaluations, whole.evaluations) << k;
    EXPECT_EQ(rest.counts.listed, whole.counts.listed) << k;
    EXPECT_EQ(rest.counts.clipped, whole.counts.clipped) << k;
    EXPECT_EQ(rest.counts.by_axis, whole.counts.by_axis) << k;
    ASSERT_EQ(rest.states.size(), whole.states.size()) << k;
    for (std::size_t s = 0; s < rest.states.size(); ++s)
      EXPECT_TRUE(same_bits(rest.states[s], whole.states[s])) << k << ", state " << s;
    EXPECT_EQ(rest.phi_j->density, whole.phi_j->density) << k;
  }
}

TEST(JamTest, DensityLimit) {
  JamOptions options = lax();
  options.compression.target_energy = 1e3;
  options.compression.max_density = 0.75;
  const JamResult result = jam(start_of(small, 71, options), options);
  EXPECT_EQ(result.status, JamStatus::density_limit) << to_string(result.status);
  EXPECT_LE(result.path.back().density, options.compression.max_density);
  EXPECT_GT(result.path.back().density, options.compression.max_density - options.compression.step * (1 + 1e-9));
  EXPECT_TRUE(result.states.empty());
  EXPECT_FALSE(result.phi_j);
}

TEST(JamTest, StepLimit) {
  JamOptions options = lax();
  options.max_steps = 5;
  const JamResult result = jam(start_of(small, 71, options), options);
  EXPECT_EQ(result.status, JamStatus::step_limit) << to_string(result.status);
  EXPECT_EQ(result.path.size(), 5U);
}

TEST(JamTest, NotFinite) {
  JamOptions options = lax();
  options.compression.initial_density = 0.6;
  Packing start = start_of(small, 71, options);
  start.poses[3].orientation.w() = std::numeric_limits<double>::quiet_NaN();
  const JamResult result = jam(start, options);
  EXPECT_EQ(result.status, JamStatus::not_finite) << to_string(result.status);
  EXPECT_TRUE(result.states.empty());
}

TEST(JamTest, TheRuleOnTheEnergyAcceptsUnbalancedStates) {
  const System system{SolidKind::dodecahedron, 24};
  auto options = lax();
  options.minimise.method = Method::conjugate_gradient;
  options.minimise.residual = 1e-9;
  const auto states_of = [&](double energy_change) {
    options.minimise.energy_change = energy_change;
    return jam(start_of(system, 5, options), options);
  };
  const auto by_energy = states_of(1e-4);
  ASSERT_GE(by_energy.states.size(), 2U) << to_string(by_energy.status);
  for (const int k : by_energy.state_steps) {
    const auto& summary = by_energy.path[static_cast<std::size_t>(k)].summary;
    EXPECT_EQ(summary.reason, StopReason::energy_change) << to_string(summary.reason);
    EXPECT_GT(summary.residual, 100 * options.minimise.residual);
  }
  // Without the rule, the same minimiser must balance the forces or reject the state.
  const auto balanced = states_of(0);
  EXPECT_GE(balanced.path.size(), by_energy.state_steps.size());
  EXPECT_NE(balanced.status, JamStatus::not_called);
  for (const int k : balanced.state_steps)
    EXPECT_TRUE(is_equilibrium(balanced.path[static_cast<std::size_t>(k)].summary));
  EXPECT_LT(balanced.states.size(), by_energy.states.size()) << "1e-9 is more than conjugate gradients reach here";
}

TEST(JamTest, TheLastStrainStepAimsAtTheTargetEnergy) {
  const Compression compression;
  const auto state_at = [](double distance) {
    JamStep state;  // E/N = (Δφ)⁶, and N p/φ² = dE/dφ
    state.density = 0.7 + distance;
    state.energy_per_particle = std::pow(distance, 6);
    state.pressure = 6 * std::pow(distance, 5) * state.density * state.density;
    return state;
  };
  const double target = std::pow(compression.target_energy, 1.0 / 6), step = compression.step;
  EXPECT_EQ(aimed_strain(compression, JamStep{}), step) << "a packing without contacts";
  for (double to_target = 3 * step; to_target > -2 * step; to_target -= step / 16) {
    const double strain = aimed_strain(compression, state_at(target - to_target));
    EXPECT_NEAR(strain, std::clamp(1.2 * to_target, step / 4, step), 1e-12) << to_target / step;
  }
}

TEST(JamTest, ATargetBeforeRelaxationEndsNearerToJamming) {
  JamOptions options = lax();
  // A minimisation must not end with energy only because it has too few evaluations.
  options.compression.evaluations = 6000;
  const auto top_of = [](const JamResult& result) {
    return result.path[static_cast<std::size_t>(result.state_steps.front())];
  };
  // If the target applies to the unrelaxed energy, rounding errors decide which packings do not jam and relax below
  // φ_J.
  int jammed = 0;
  for (const std::uint64_t seed : {71, 72, 73, 74, 75, 76}) {
    options.compression.target_before_relaxation = false;
    const JamResult usual = jam(start_of(small, seed, options), options);
    options.compression.target_before_relaxation = true;
    const JamResult gentle = jam(start_of(small, seed, options), options);
    ASSERT_EQ(usual.status, JamStatus::jammed) << to_string(usual.status);
    if (gentle.status != JamStatus::jammed) continue;
    ++jammed;
    std::printf("decompression starts at φ %.3f, E/N %.1e; by the other reading at %.3f, %.1e, φ_J %.3f\n",
                top_of(usual).density, top_of(usual).energy_per_particle, top_of(gentle).density,
                top_of(gentle).energy_per_particle, gentle.phi_j->density);
    EXPECT_LT(top_of(gentle).density, top_of(usual).density - options.compression.step);
    EXPECT_LT(top_of(gentle).energy_per_particle, options.compression.target_energy / 100);
    // The target was reached one strain step beyond the last state that could relax completely, which is below φ_J.
    EXPECT_LT(top_of(gentle).density - gentle.phi_j->density, 1.5 * options.compression.step);
  }
  EXPECT_GE(jammed, 2);
}

}  // namespace
}  // namespace isojam
