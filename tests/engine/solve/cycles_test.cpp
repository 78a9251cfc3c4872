#include "engine/solve/jam.hpp"
#include "tests/engine/solve/jam_support.hpp"
#include "tests/engine/solve/solve_support.hpp"

namespace isojam {
namespace {

const System octahedra{SolidKind::octahedron, 48};

JamOptions with_cycles(int cycles) {
  JamOptions options = lax();
  options.cycles = cycles;
  return options;
}

TEST(Cycles, BeginWithTheRunWithoutCycles) {
  const JamOptions options = with_cycles(2);
  const JamResult plain = jam(start_of(octahedra, 3, options), lax());
  const JamResult trained = jam(start_of(octahedra, 3, options), options);
  ASSERT_EQ(plain.status, JamStatus::jammed);
  ASSERT_EQ(trained.status, JamStatus::jammed);
  ASSERT_EQ(trained.cycles.size(), 2U);
  EXPECT_EQ(trained.cycles[0].phi_j, plain.phi_j->density);
  ASSERT_TRUE(trained.cycles[0].nearest);
  EXPECT_EQ(trained.cycles[0].nearest->poses, plain.states.back().poses);
  int compressions = 0;
  for (std::size_t k = 0; k < trained.path.size(); ++k) {
    const bool compressed = trained.path[k].stage == JamStage::compression;
    if (compressed && (k == 0 || trained.path[k - 1].stage == JamStage::decompression)) ++compressions;
    if (k < plain.path.size()) {
      EXPECT_EQ(trained.path[k].density, plain.path[k].density);
    }
  }
  EXPECT_EQ(compressions, 3);
  std::printf("φ_J %.4f, %.4f, %.4f\n", trained.cycles[0].phi_j.value_or(0), trained.cycles[1].phi_j.value_or(0),
              trained.phi_j->density);
  for (const int step : trained.state_steps) EXPECT_GE(step, static_cast<int>(plain.path.size()));
}

TEST(Cycles, ContinueFromAnyProgress) {
  const JamOptions options = with_cycles(1);
  std::vector<JamProgress> saved;
  const JamResult whole =
      jam(start_of(octahedra, 4, options), options, {}, [&](const JamProgress& at) { saved.push_back(at); });
  ASSERT_GT(saved.size(), 8U);
  for (const std::size_t k : {std::size_t{1}, saved.size() / 2, 3 * saved.size() / 4, saved.size() - 2}) {
    const JamResult rest = jam(saved[k], options);
    ASSERT_FALSE(rest.states.empty());
    EXPECT_EQ(rest.states.back().poses, whole.states.back().poses) << k;
    EXPECT_EQ(rest.phi_j->density, whole.phi_j->density) << k;
    EXPECT_EQ(rest.cycles.at(0).phi_j, whole.cycles.at(0).phi_j) << k;
    EXPECT_EQ(rest.evaluations, whole.evaluations) << k;
  }
}

TEST(Cycles, WithoutAStateHaveNoValues) {
  JamOptions options = with_cycles(1);
  options.minimise.method = Method::lbfgs;
  options.minimise.max_evaluations = 1;
  options.compression.target_before_relaxation = true;
  const JamResult result = jam(start_of(octahedra, 5, options), options);
  ASSERT_EQ(result.cycles.size(), 1U);
  EXPECT_FALSE(result.cycles[0].phi_j);
  EXPECT_FALSE(result.cycles[0].nearest);
  EXPECT_EQ(result.status, JamStatus::not_jammed);
}

}  // namespace
}  // namespace isojam
