
#include "engine/solve/jam.hpp"
#include "engine/solve/rearrangement.hpp"
#include "tests/engine/solve/jam_support.hpp"
#include "tests/engine/solve/solve_support.hpp"

namespace isojam {
namespace {

/// A decompression whose last state indicates that φ_J is `distance` below its density.
JamProgress expanding(const Packing& packing, double distance, const JamOptions& options) {
  JamProgress progress = begin_jam(packing, options);
  progress.stage = JamStage::decompression;
  JamStep state;
  state.stage = JamStage::decompression;
  state.density = packing.density();
  state.energy_per_particle = 1e-8;
  state.pressure = 6 * state.energy_per_particle * state.density * state.density / distance;
  progress.result.path.push_back(state);
  progress.result.states.push_back(packing);
  progress.result.state_steps.push_back(0);
  return progress;
}

/// The decompression of a few dodecahedra.
JamResult expanded(JamOptions& options) {
  options = lax();
  options.decompression.fit_window = 0.1;
  return jam(start_of(small, 71, options), options);
}

/// A decompression that continues from the last state of another one. Its distance to jamming is overestimated by
/// `factor`, and its steps are 0.4 of this distance.
JamProgress misled(const JamResult& before, double factor, JamOptions& options) {
  const JamStep& last = before.path[static_cast<std::size_t>(before.state_steps.back())];
  JamProgress progress = expanding(before.states.back(), factor * distance_to_jamming(last), options);
  JamStep& told = progress.result.path[0];
  told.summary.reason = StopReason::residual_reached;
  told.energy_per_particle = last.energy_per_particle;
  told.pressure = last.pressure / factor;
  options.decompression.step_fraction = progress.step_fraction = 0.4;
  options.decompression.longest_step = 1;
  return progress;
}

TEST(JamTest, AFailedDecompressionStepIsRepeatedWithHalfItsLength) {
  RandomStream random{91};
  const Packing packing = small_packing(SolidKind::dodecahedron, 0.72, 91);
  int by_fraction = 0, by_length = 0, by_goal = 0;
  for (int sample = 0; sample < 200; ++sample) {
    const double distance = decade(random, -4, -0.5);
    JamOptions options;
    options.decompression.step_fraction = uniform(random, 0.02, 0.98);
    options.decompression.longest_step = decade(random, -3, -0.5);
    options.decompression.final_distance = distance * uniform(random, 0.01, 0.99);
    options.minimise.max_evaluations = 1;  // no step succeeds
    SCOPED_TRACE("distance " + std::to_string(distance) + ", step_fraction " +
                 std::to_string(options.decompression.step_fraction) + ", longest_step " +
                 std::to_string(options.decompression.longest_step) + ", final_distance " +
                 std::to_string(options.decompression.final_distance));
    const JamResult result = jam(expanding(packing, distance, options), options);
    ASSERT_EQ(result.status, JamStatus::not_jammed) << to_string(result.status);
    ASSERT_EQ(result.states.size(), 1U);
    ASSERT_EQ(result.path.size(), distance > 1e-3 ? 6U : 9U) << "a step, and four retries or, near jamming, seven";
    const double fraction = options.decompression.step_fraction * distance,
                 goal = distance - 0.95 * options.decompression.final_distance;
    double expected = std::min({fraction, options.decompression.longest_step, goal});
    ++(expected == fraction ? by_fraction : expected == goal ? by_goal : by_length);
    for (std::size_t k = 1; k < result.path.size(); ++k, expected /= 2) {
      const double step = packing.density() - result.path[k].density;
      ASSERT_NEAR(step / expected, 1, 1e-8) << "attempt " << k << ", step " << step;
    }
  }
  std::printf("bounded by the fraction %d, by longest_step %d, by final_distance %d times\n", by_fraction, by_length,
              by_goal);
  EXPECT_GE(std::min({by_fraction, by_length, by_goal}), 20) << "samples that do not reach every bound";
}

TEST(JamTest, AnUnjammedPackingIsCompressedAgain) {
  JamOptions options;
  const JamResult before = expanded(options);
  ASSERT_EQ(before.status, JamStatus::jammed);
  const JamProgress progress = misled(before, 4, options);  // the steps pass the jamming point
  std::vector<JamProgress> along;
  const JamResult result = jam(progress, options, {}, [&](const JamProgress& reached) { along.push_back(reached); });
  for (const JamStep& step : result.path)
    std::printf("φ %.5f, E/N %.2e, %s\n", step.density, step.energy_per_particle,
                to_string(step.summary.reason).data());
  ASSERT_GE(result.path.size(), 4U);
  EXPECT_EQ(result.path[1].summary.reason, StopReason::unjammed);
  EXPECT_GT(result.path[2].density, result.path[1].density) << "strained up again";
  EXPECT_EQ(result.status, JamStatus::jammed) << to_string(result.status);
  ASSERT_GE(result.states.size(), 2U);
  EXPECT_GT(result.state_steps.front(), 1) << "a state of the branch that ended is kept";
  ASSERT_TRUE(result.phi_j);
  EXPECT_NEAR(result.phi_j->density, before.phi_j->density, 0.03);
  ASSERT_FALSE(along.empty());
  EXPECT_EQ(along.front().lost, 0);
  EXPECT_EQ(along.back().lost, -1);
  for (std::size_t k = 0; k < result.path.size(); ++k) EXPECT_EQ(result.path[k].lost, k == 1) << "step " << k;
  // During the recompression too, a run depends only on the progress from which it continues.
  for (const JamProgress& reached : along) {
    const JamResult rest = jam(reached, options);
    ASSERT_EQ(rest.states.size(), result.states.size());
    for (std::size_t s = 0; s < rest.states.size(); ++s) EXPECT_TRUE(same_bits(rest.states[s], result.states[s])) << s;
  }
}

TEST(JamTest, AStepWithoutEquilibriumEndsItsBranch) {
  JamOptions options;
  const JamResult before = expanded(options);
  ASSERT_EQ(before.status, JamStatus::jammed);
  JamProgress progress = misled(before, 1, options);
  options.decompression.final_distance = 0.001;  // a longer decompression
  const JamOptions usual = options;
  options.minimise.max_evaluations = 3;  // no step reaches an equilibrium
  const double from = progress.packing.density();
  advance(progress, options);
  const JamStep first = progress.result.path.back();
  EXPECT_EQ(first.summary.reason, StopReason::budget) << to_string(first.summary.reason);
  EXPECT_FALSE(first.lost);
  EXPECT_EQ(progress.lost, -1);
  advance(progress, options);
  const JamStep second = progress.result.path.back();
  EXPECT_EQ(second.summary.reason, StopReason::budget) << to_string(second.summary.reason);
  EXPECT_NEAR((from - second.density) / (from - first.density), 0.5, 1e-9);
  EXPECT_TRUE(second.lost);
  EXPECT_EQ(progress.lost, 0);
  EXPECT_EQ(progress.packing.density(), second.density);
  ASSERT_FALSE(progress.ended());
  // From there the packing is compressed again.
  advance(progress, usual);
  EXPECT_GT(progress.result.path.back().density, second.density);
}

TEST(JamTest, AStepWithoutEquilibriumNearJammingOnlyShortensTheNextOnes) {
  JamOptions options;
  const JamResult before = expanded(options);
  const double distance = distance_to_jamming(before.path[static_cast<std::size_t>(before.state_steps.back())]);
  for (const double said : {5e-4, 2e-3}) {
    JamOptions usual = options;
    JamProgress progress = misled(before, said / distance, usual);
    usual.decompression.final_distance = 1e-5;
    JamOptions failing = usual;
    failing.minimise.max_evaluations = 3;  // no step reaches an equilibrium
    advance(progress, failing);
    EXPECT_DOUBLE_EQ(progress.step_fraction, .2);
    advance(progress, failing);
    EXPECT_EQ(progress.result.path.back().summary.reason, StopReason::budget);
    const bool near = said < 1e-3;
    EXPECT_EQ(progress.lost, near ? -1 : 0);
    EXPECT_DOUBLE_EQ(progress.step_fraction, .1);
    if (!near) continue;
    advance(progress, usual);
    ASSERT_EQ(progress.result.states.size(), 2U);
    EXPECT_DOUBLE_EQ(progress.step_fraction, .1);
  }
}

TEST(JamTest, APackingThatLosesItsEnergyIsCompressedFurther) {
  const JamOptions options = lax();
  JamProgress progress = begin_jam(start_of(small, 71, options), options);
  progress.stage = JamStage::decompression;  // as if this unjammed packing had reached the target energy
  const double from = progress.packing.density();
  JamProgress other = progress;
  advance(progress, options);
  ASSERT_FALSE(progress.ended()) << to_string(progress.result.status);
  EXPECT_EQ(progress.stage, JamStage::compression);
  EXPECT_TRUE(progress.result.states.empty());
  EXPECT_EQ(progress.packing.density(), from);
  const JamResult result = jam(progress, options);
  EXPECT_EQ(result.status, JamStatus::jammed) << to_string(result.status);
  const JamStep& top = result.path[static_cast<std::size_t>(result.state_steps.front())];
  EXPECT_GE(top.energy_per_particle, options.compression.target_energy / 2);
  // If the target applies to the unrelaxed energy, compression ends with almost no energy.
  JamOptions gentle = options;
  gentle.compression.target_before_relaxation = true;
  advance(other, gentle);
  EXPECT_TRUE(other.ended());
}

}  // namespace
}  // namespace isojam
