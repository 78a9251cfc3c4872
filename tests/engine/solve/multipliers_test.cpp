// Equilibria are checked by forces and torques that are summed independently from the contacts.

#include "engine/solve/multipliers/multipliers.hpp"

#include <oneapi/tbb/global_control.h>

#include <map>
#include <stop_token>

#include "engine/solve/minimise/descent.hpp"
#include "engine/solve/multipliers/lifted_step.hpp"
#include "engine/solve/multipliers/local_relaxation.hpp"
#include "engine/solve/rearrangement.hpp"
#include "tests/engine/solve/solve_support.hpp"

namespace isojam {
namespace {

constexpr std::array solids{SolidKind::tetrahedron, SolidKind::octahedron, SolidKind::dodecahedron,
                            SolidKind::icosahedron};

struct State {
  Packing packing;
  double distance = 0;
};

double distance_of(const Packing& packing) {
  const Evaluation value = PackingEnergy().evaluate(packing, Precision::double_double);
  return 6 * value.energy / packing.size() * packing.density() * packing.density() / value.pressure;
}

double energy_of(const Packing& packing) { return PackingEnergy().evaluate(packing, Precision::double_double).energy; }

/// Equilibria found by Newton's method, from far above jamming to Δφ = 0.01.
const std::vector<State>& states(SolidKind kind) {
  static std::map<SolidKind, std::vector<State>> all;
  const auto [place, is_new] = all.try_emplace(kind);
  if (!is_new) return place->second;
  JamOptions options;
  options.compression.initial_density = 0.3;
  options.decompression.final_distance = 0.01;
  options.minimise.method = Method::newton;
  options.minimise.residual = 1e-7;
  const JamResult result = jam(small_packing(kind, options.compression.max_density, 321, 64), options);
  for (const Packing& packing : result.states) {
    const double distance = distance_of(packing);
    if (distance < 0.13) place->second.push_back({packing, distance});
  }
  return place->second;
}

struct Followed {
  Packing packing;
  MinimiseSummary summary;
};

Followed followed(const State& from, double ratio, const MinimiseOptions& options = {}, std::stop_token stop = {}) {
  Packing packing = from.packing;
  PackingEnergy energy;
  const MinimiseSummary summary = follow_equilibrium(packing, packing.density() - ratio * from.distance, from.distance,
                                                     energy, options, std::move(stop));
  return {packing, summary};
}

Followed by_newton(const State& from, double ratio) {
  Packing packing = strained_to(from.packing, from.packing.density() - ratio * from.distance);
  PackingEnergy energy;
  MinimiseOptions options;
  options.method = Method::newton;
  const MinimiseSummary summary = minimise(packing, energy, options);
  return {packing, summary};
}

class Multipliers : public testing::TestWithParam<SolidKind> {};
INSTANTIATE_TEST_SUITE_P(Solids, Multipliers, testing::ValuesIn(solids),
                         [](const auto& test) { return std::string(to_string(test.param)); });

TEST_P(Multipliers, FindTheEquilibriaThatNewtonFinds) {
  int same = 0, compared = 0;
  long by_multipliers = 0, by_newton_alone = 0;
  for (const State& from : states(GetParam())) {
    for (const double ratio : {0.05, 0.35}) {
      const Followed found = followed(from, ratio);
      const Followed oracle = by_newton(from, ratio);
      SCOPED_TRACE("from Δφ " + std::to_string(from.distance) + " by " + std::to_string(ratio));
      ASSERT_TRUE(is_equilibrium(found.summary)) << to_string(found.summary.reason);
      EXPECT_NEAR(found.packing.density(), from.packing.density() - ratio * from.distance, 1e-14);
      const Evaluation fresh = PackingEnergy().evaluate(found.packing, found.summary.precision);
      EXPECT_EQ(found.summary.energy, fresh.energy);
      EXPECT_EQ(found.summary.residual, fresh.residual);
      EXPECT_LE(fresh.residual, 1e-6);
      EXPECT_LE(balance_of(found.packing).residual, 1e-6 + 10 * PackingEnergy().evaluate(found.packing).residual_floor);
      by_multipliers += found.summary.work.hessians;
      by_newton_alone += oracle.summary.work.hessians;
      if (!is_equilibrium(oracle.summary)) continue;
      ++compared;
      const double difference = found.summary.energy / oracle.summary.energy - 1;
      same += std::abs(difference) < 1e-6;
      std::printf("Δφ %.4f by %.2f: E differs by %.1e; %ld Hessians (%ld local), Newton %ld\n", from.distance, ratio,
                  difference, found.summary.work.hessians, found.summary.work.local_factorisations,
                  oracle.summary.work.hessians);
    }
  }
  EXPECT_GE(compared, 6);
  EXPECT_GE(2 * same, compared) << "branches part at an avalanche, not everywhere";
  EXPECT_LT(by_multipliers, by_newton_alone);
}

TEST_P(Multipliers, RelaxNeedsNoEquilibriumToStartFrom) {
  for (const State& from : states(GetParam())) {
    const double ratio = 0.1, force = PackingEnergy().evaluate(from.packing).mean_force;
    for (const double guess : {0.2, 5.0}) {
      Packing packing = strained_to(from.packing, from.packing.density() - ratio * from.distance);
      PackingEnergy energy;
      const MinimiseSummary summary = relax_to_equilibrium(packing, guess * force * std::pow(1 - ratio, 5),
                                                           from.distance * (1 - ratio), energy, {});
      EXPECT_TRUE(is_equilibrium(summary)) << to_string(summary.reason) << " from Δφ " << from.distance;
      EXPECT_LT(energy_of(packing), energy_of(strained_to(from.packing, packing.density())));
    }
  }
}

TEST_P(Multipliers, ReportAnUnjammedPacking) {
  // The assumed distance to jamming is three times too large.
  const State& from = states(GetParam()).back();
  const Followed found = followed({from.packing, 3 * from.distance}, 0.6);
  EXPECT_EQ(found.summary.reason, StopReason::unjammed) << to_string(found.summary.reason);
  EXPECT_LT(found.summary.energy, 1e-4 * energy_of(from.packing));
}

TEST_P(Multipliers, StopAtTheLimitAndOnRequest) {
  const State& from = states(GetParam()).front();
  MinimiseOptions options;
  options.max_evaluations = 3;
  const Followed poor = followed(from, 0.35, options);
  EXPECT_EQ(poor.summary.reason, StopReason::budget) << to_string(poor.summary.reason);
  std::stop_source stop;
  stop.request_stop();
  const Followed stopped = followed(from, 0.35, {}, stop.get_token());
  EXPECT_EQ(stopped.summary.reason, StopReason::interrupted) << to_string(stopped.summary.reason);
}

TEST_P(Multipliers, AnyNumberOfThreadsGivesTheSameBits) {
  const State& from = states(GetParam()).back();
  std::vector<Followed> ends;
  for (const std::size_t threads : {1U, 2U}) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    ends.push_back(followed(from, 0.35));
  }
  EXPECT_TRUE(same_bits(ends[0].packing, ends[1].packing));
  EXPECT_EQ(ends[0].summary.residual, ends[1].summary.residual);
  EXPECT_TRUE(ends[0].summary.work == ends[1].summary.work);
}

TEST(Rearrangement, CountsMovedParticles) {
  const State& from = states(SolidKind::octahedron).front();
  JamStep before, after;
  before.density = from.packing.density();
  before.energy_per_particle = energy_of(from.packing) / from.packing.size();
  before.pressure = PackingEnergy().evaluate(from.packing).pressure;
  after = before;
  const Rearrangement none = rearrangement(from.packing, before, from.packing, after);
  EXPECT_EQ(none.energy_ratio, 1);
  EXPECT_EQ(none.contacts_lost + none.contacts_gained, 0);
  EXPECT_EQ(none.particles_moved, 0);
  // Only one particle moves.
  Packing moved_one = from.packing;
  moved_one.poses[5].position.x() += 0.3;
  const Rearrangement one = rearrangement(from.packing, before, moved_one, after);
  EXPECT_NEAR(one.particles_moved, 1, 1e-9);
  EXPECT_GT(one.contacts_lost + one.contacts_gained, 0);
}

}  // namespace
}  // namespace isojam
