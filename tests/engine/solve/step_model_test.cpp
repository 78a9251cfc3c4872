#include "engine/solve/minimise/step_model.hpp"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <limits>

#include "engine/solve/minimise/descent.hpp"
#include "engine/solve/minimise/minimise.hpp"
#include "tests/engine/solve/solve_support.hpp"

namespace isojam {
namespace {

using Eigen::Vector3d;
using Eigen::VectorXd;

constexpr double unlimited = std::numeric_limits<double>::max();

/// Three unit cubes in a row along x: the first two overlap by `depth`, the third one is `gap` away.
Packing row_of_cubes(double depth, double gap) {
  Packing packing{platonic(SolidKind::cube), PeriodicCell(10), std::vector<Pose>(3)};
  packing.poses[0].position = Vector3d(3, 5, 5);
  packing.poses[1].position = Vector3d(4 - depth, 5, 5);
  packing.poses[2].position = Vector3d(5 - depth + gap, 5, 5);
  return packing;
}

struct Case {
  Packing packing;
  Evaluation value;
  SecondOrder second;
};

Case case_of(const Packing& packing, double probe_distance) {
  PackingEnergy energy;
  Evaluation value = energy.evaluate(packing);
  SecondOrder second = energy.second_order(packing, probe_distance);
  return {packing, std::move(value), std::move(second)};
}

TEST(StepModel, IsNewtonsStepIfNoPairCloses) {
  for (const SolidKind kind : all_solids) {
    const Case state = case_of(small_packing(kind, 0.8, 31), 0);
    StepModel model(state.second, state.value.gradient, unlimited);
    double shift = 2 * model.largest_diagonal();  // large: all tilt terms are included, no contact tilts alone
    StepFactor factor;
    ActivePairs active;
    std::optional<ModelStep> step;
    while (!(step = model.minimise(shift, factor, active))) shift *= 2;
    EXPECT_TRUE(active.closing.empty());
    const Eigen::MatrixXd hessian = dense(state.second.hessian);
    Eigen::MatrixXd matrix = hessian + shift * Eigen::MatrixXd::Identity(hessian.rows(), hessian.cols());
    for (const IncipientContact& pair : state.second.pairs) {
      matrix.block<3, 3>(6 * pair.a + 3, 6 * pair.a + 3) += pair.tilt;
      matrix.block<3, 3>(6 * pair.b + 3, 6 * pair.b + 3) += pair.tilt;
      matrix.block<3, 3>(6 * pair.a + 3, 6 * pair.b + 3) -= pair.tilt;
      matrix.block<3, 3>(6 * pair.b + 3, 6 * pair.a + 3) -= pair.tilt;
    }
    const VectorXd expected = -matrix.llt().solve(state.value.gradient);
    EXPECT_LE((step->displacement - expected).norm(), 1e-12 * expected.norm()) << platonic(kind).name();
    const double decrease = -state.value.gradient.dot(expected) - expected.dot(hessian * expected) / 2;
    EXPECT_NEAR(step->decrease, decrease, 1e-12 * decrease) << platonic(kind).name();
  }
}

/// Minimum of (V_01² + V_12²)/4 + shift·s²/2 over the steps s of the three cubes along the row. The faces have area 1,
/// so V_01 = depth + s_0 − s_1 and V_12 = s_1 − s_2 − gap. If `meet` is false, V_12 = 0.
Vector3d balanced_row(double depth, double gap, double shift, bool meet) {
  const Vector3d first(1, -1, 0), second = meet ? Vector3d(0, 1, -1) : Vector3d::Zero();
  const Eigen::Matrix3d matrix = (first * first.transpose() + second * second.transpose()) / 2;
  return (matrix + shift * Eigen::Matrix3d::Identity()).llt().solve((gap * second - depth * first) / 2);
}

/// The first cube pushes the middle one across the gap to the third one.
TEST(StepModel, StopsWhereFacesMeet) {
  const double depth = 1e-4, gap = 1e-6;
  const Case state = case_of(row_of_cubes(depth, gap), 1e-5);
  ASSERT_EQ(state.value.contacts, 1);
  StepModel model(state.second, state.value.gradient, unlimited);
  const double shift = 1e-3 * model.largest_diagonal();
  StepFactor factor;
  ActivePairs found, none, wrong{{{0, 1}, {1, 2}}, {{0, 1}}};
  const auto step = model.minimise(shift, factor, found);
  ASSERT_TRUE(step);
  ASSERT_EQ(found.closing, (std::vector<std::pair<int, int>>{{1, 2}}));
  const auto expect_balanced = [&](const ModelStep& seen, bool meet) {
    VectorXd along = VectorXd::Zero(18);
    along(Eigen::seqN(0, 3, 6)) = balanced_row(depth, gap, shift, meet);
    EXPECT_LE((seen.displacement - along).norm(), 1e-9 * along.norm())
        << seen.displacement.transpose() << "\ninstead of " << along.transpose();
  };
  expect_balanced(*step, true);
  const LinearisedOverlap& closed = state.second.pairs.at(1).closed;
  const double overlap = closed.at(step->displacement, 1, 2), taken_up = 2 * shift * step->displacement[12];
  EXPECT_GT(overlap, 0);
  EXPECT_NEAR(overlap, taken_up, 1e-6 * overlap) << "half of V is the push that the third cube takes up";
  for (ActivePairs guess : {found, wrong}) {
    const auto again = model.minimise(shift, factor, guess);
    ASSERT_TRUE(again);
    expect_balanced(*again, true);
    EXPECT_EQ(guess.closing, found.closing);
  }
  model.forget_closing_pairs();
  const auto blind = model.minimise(shift, factor, none);
  ASSERT_TRUE(blind);
  EXPECT_TRUE(none.closing.empty());
  expect_balanced(*blind, false);
  EXPECT_GT(closed.at(blind->displacement, 1, 2), 10 * gap) << "nothing in its way";
}

/// The state after a strain step from an equilibrium.
Packing relaxed_and_strained(SolidKind kind, std::uint64_t seed) {
  Packing packing = small_packing(kind, over_compressed(kind), seed, 48);
  PackingEnergy energy;
  minimise(packing, energy, {});
  return strained_to(packing, packing.density() - 0.01);
}

/// Pairs that are found in later rounds are included by updates of the factors. Pairs of the initial estimate are
/// included in the matrix.
TEST(StepModel, TheInitialEstimateDoesNotChangeTheStep) {
  int compared = 0, found_later = 0;
  for (const SolidKind kind : all_solids) {
    for (const std::uint64_t seed : {41, 42}) {
      const Packing packing = relaxed_and_strained(kind, seed);
      const Case state = case_of(packing, 2e-3 * packing.solids.only().inradius());
      StepModel model(state.second, state.value.gradient, 0.05 * packing.solids.only().inradius());
      double shift = 1e-9 * model.largest_diagonal();  // so small that not every contact has its tilt term
      StepFactor factor;
      ActivePairs from_none;
      auto step = model.minimise(shift, factor, from_none);
      while (!step) step = model.minimise(shift *= 4, factor, from_none = {});
      ActivePairs from_found = from_none;
      const auto again = model.minimise(shift, factor, from_found);
      ASSERT_TRUE(again);
      if (from_found.closing != from_none.closing || from_found.tilted != from_none.tilted) continue;
      ++compared;
      found_later += from_none.closing.size() + from_none.tilted.size() > 0;
      EXPECT_LE((again->displacement - step->displacement).norm(), 1e-9 * step->displacement.norm())
          << platonic(kind).name() << ", seed " << seed << ": " << from_none.closing.size() << " closing, "
          << from_none.tilted.size() << " tilted";
    }
  }
  EXPECT_GE(compared, 5);
  EXPECT_GE(found_later, 3);
}

/// The shift keeps the outer cubes in place. The middle one moves to its equilibrium between them.
TEST(StepModel, PredictedDecreaseAgreesWithTheEnergy) {
  const double depth = 1e-4, gap = 1e-6;
  const Packing packing = row_of_cubes(depth, gap);
  const auto outcome = [&](bool anticipate) {
    const Case state = case_of(packing, 1e-5);
    StepModel model(state.second, state.value.gradient, unlimited);
    if (!anticipate) model.forget_closing_pairs();
    StepFactor factor;
    ActivePairs active;
    const auto step = model.minimise(0.01 * model.largest_diagonal(), factor, active);
    const double actual = state.value.energy - PackingEnergy().evaluate(moved(packing, step->displacement)).energy;
    return std::pair(step->decrease, actual);
  };
  const auto [promised, actual] = outcome(true);
  EXPECT_GT(actual, 0);
  EXPECT_NEAR(promised, actual, 0.01 * actual);
  const auto [hoped, got] = outcome(false);
  EXPECT_GT(hoped - got, 0.1 * hoped) << "promised " << hoped << ", got " << got;
}

TEST(StepModel, KeepsToTheLongestStep) {
  const Case state = case_of(small_packing(SolidKind::octahedron, 0.8, 33), 0.01);
  for (const double longest : {1e-2, 1e-4, 1e-8}) {
    StepModel model(state.second, state.value.gradient, longest);
    StepFactor factor;
    ActivePairs active;
    for (double shift = 1e-6 * model.largest_diagonal(); shift <= 1e3 * model.largest_diagonal(); shift *= 10) {
      const auto step = model.minimise(shift, factor, active);
      if (!step) continue;
      EXPECT_LE(largest_displacement(step->displacement), longest * (1 + 1e-12)) << "shift " << shift;
    }
  }
}

}  // namespace
}  // namespace isojam
