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

TEST_P(Multipliers, SmallStepsNeedFewHessians) {
  std::vector<long> counts;
  for (const State& from : states(GetParam())) {
    const Followed found = followed(from, 0.03);
    EXPECT_TRUE(is_equilibrium(found.summary)) << to_string(found.summary.reason);
    counts.push_back(found.summary.work.hessians);
  }
  ASSERT_FALSE(counts.empty());
  std::sort(counts.begin(), counts.end());
  std::printf("%zu states, %ld to %ld Hessians, median %ld\n", counts.size(), counts.front(), counts.back(),
              counts[counts.size() / 2]);
  EXPECT_LE(counts[counts.size() / 2], 20);
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

/// An equilibrium with its own multipliers, and the stiffness with which it is followed.
struct Prepared {
  MinimiseWork work;
  EnvelopeEvaluator evaluator;
  EnvelopeState state;

  explicit Prepared(const State& from) : evaluator(Enthalpy({}, from.packing.cell), work), state{from.packing, {}} {
    evaluator.set_stiffness(1);
    const double force = evaluator.unshifted(from.packing).value.mean_force;
    evaluator.set_stiffness(300 * force / from.distance);
    state = evaluator.unshifted(from.packing);
  }
};

Eigen::VectorXd disturbance(const State& from, double size) {
  RandomStream random{322};
  return size * normal_vector(6 * from.packing.size(), random);
}

TEST_P(Multipliers, LocalRelaxationMovesOnlyFlaggedParticles) {
  const State& from = states(GetParam()).back();
  Prepared prepared(from);
  const int n = from.packing.size();
  std::vector<char> flags(static_cast<std::size_t>(n), 0);
  Eigen::VectorXd step = Eigen::VectorXd::Zero(6 * n);
  for (int p = 0; p < n / 8; ++p) {
    flags[static_cast<std::size_t>(p)] = 1;
    step.segment<6>(6 * p) = disturbance(from, from.distance / 30).segment<6>(6 * p);
  }
  const EnvelopeState spoilt = prepared.evaluator.at(moved(from.packing, step), forces_after(prepared.state, step));
  EnvelopeState relaxed = spoilt;
  const double promised = spoilt.value.value - prepared.state.value.value;
  EXPECT_GT(promised, 0);
  const double shift = 0.1 * prepared.state.value.mean_force / from.distance;
  EXPECT_TRUE(relax_locally(flags, shift, promised, prepared.evaluator, relaxed, prepared.work));
  EXPECT_LT(relaxed.value.value - prepared.state.value.value, 0.1 * promised);
  EXPECT_GT(prepared.work.local_factorisations, 0);
  for (int p = 0; p < n; ++p) {
    const Pose &before = spoilt.packing.poses[static_cast<std::size_t>(p)],
               &after = relaxed.packing.poses[static_cast<std::size_t>(p)];
    EXPECT_EQ(before.position == after.position, flags[static_cast<std::size_t>(p)] == 0) << "particle " << p;
  }
  const std::vector<char> none(static_cast<std::size_t>(n), 0);
  EXPECT_FALSE(relax_locally(none, shift, promised, prepared.evaluator, relaxed, prepared.work));
}

TEST_P(Multipliers, LiftedStepsConvergeQuadratically) {
  const State& from = states(GetParam()).back();
  Prepared prepared(from);
  const Eigen::VectorXd step = disturbance(from, 1e-4 * from.distance);
  EnvelopeState state = prepared.evaluator.at(moved(from.packing, step), forces_after(prepared.state, step));
  BlockCholesky complete;
  DefiniteSolver solver(complete);
  const double k0 = state.value.mean_force / from.distance;
  std::vector<double> wrong;
  for (int k = 0; k < 4; ++k) {
    wrong.push_back(std::max(largest_displacement(state.value.gradient), state.value.multiplier_error) /
                    state.value.mean_force);
    auto next = lifted_step(state, 1e8 * k0, 1e-7 * k0, 0.01, prepared.evaluator, solver, prepared.work);
    ASSERT_TRUE(next);
    state = std::move(*next);
  }
  std::printf("wrong by %.1e, %.1e, %.1e, %.1e of the mean force\n", wrong[0], wrong[1], wrong[2], wrong[3]);
  EXPECT_LT(wrong[3] / wrong[2], wrong[1] / wrong[0]);
  EXPECT_LT(wrong[1], 0.3 * wrong[0]);
  EXPECT_LT(wrong[3], 1e-5);
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
