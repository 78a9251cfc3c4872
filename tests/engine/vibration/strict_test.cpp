#include "engine/vibration/strict.hpp"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cstdio>
#include <map>

#include "engine/solve/rearrangement.hpp"
#include "engine/vibration/dynamical_matrix.hpp"
#include "engine/vibration/moduli.hpp"
#include "engine/vibration/settle.hpp"
#include "tests/engine/vibration/jammed_states.hpp"

namespace isojam {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

const JamResult& free_states(SolidKind kind, int n) {
  static std::map<SolidKind, JamResult> made;
  const auto [place, is_new] = made.try_emplace(kind);
  if (is_new) {
    JamOptions options;
    options.compression.initial_density = .2;
    options.compression.step = .03;
    options.decompression.final_distance = .02;
    options.decompression.control = Control::pressure;
    options.cell = CellShape::free;
    RandomStream random{17, static_cast<std::uint64_t>(kind)};
    place->second = jam(random_packing(platonic(kind), n, options.compression.initial_density, random), options);
    settle(place->second, options);
  }
  return place->second;
}

struct Counts {
  int negative = 0, zero = 0;
};

Counts dense_counts(const MatrixXd& matrix, double tolerance) {
  const VectorXd lambda = Eigen::SelfAdjointEigenSolver<MatrixXd>(matrix, Eigen::EigenvaluesOnly).eigenvalues();
  return {static_cast<int>((lambda.array() < -tolerance).count()),
          static_cast<int>((lambda.array().abs() <= tolerance).count())};
}

constexpr int count = 70;

class Strict : public testing::TestWithParam<SolidKind> {};

INSTANTIATE_TEST_SUITE_P(Solids, Strict, testing::Values(SolidKind::octahedron, SolidKind::dodecahedron),
                         [](const auto& test) { return std::string(to_string(test.param)); });

TEST_P(Strict, CountsAreThoseOfADenseSolver) {
  for (const JamResult* result : {&jammed(GetParam(), count, .02), &free_states(GetParam(), count)}) {
    for (const Packing& packing : result->states) {
      PackingEnergy energy;
      const Evaluation here = energy.evaluate(packing, Precision::double_double);
      const Stability stability = strict_stability(packing, here, Precision::double_double);
      const BlockMatrix matrix = enthalpy_hessian(packing, strict_control(here), Precision::double_double);
      const Counts counts = dense_counts(dense_matrix(matrix), stability.tolerance);
      std::printf("phi %.3f: %d negative, %d zero\n", packing.density(), stability.negative, stability.zero);
      EXPECT_EQ(stability.negative, counts.negative);
      EXPECT_EQ(stability.zero, counts.zero);
      EXPECT_EQ(stability.zero + stability.negative + stability.positive, 6 * packing.size() + 6);
    }
  }
}

TEST_P(Strict, TheComplementOfTheStrainsIsTheElasticTensor) {
  const Packing& packing = jammed(GetParam(), count, .02).states.back();
  PackingEnergy energy;
  const Evaluation here = energy.evaluate(packing, Precision::double_double);
  const BlockMatrix hessian = energy.hessian(packing, Precision::double_double);
  const auto tensor = elastic_tensor(packing, hessian, energy.contacts(packing), here);
  ASSERT_TRUE(tensor);
  const BlockMatrix matrix = enthalpy_hessian(packing, strict_control(here), Precision::double_double);
  const auto softest = softest_strain(matrix);
  ASSERT_TRUE(softest);
  Matrix6d expected = tensor->relaxed;
  expected.topLeftCorner<3, 3>().array() += here.pressure;           // contribution of p V
  const double per_strain = packing.cell.volume() / packing.size();  // ℓ² = N
  const double least = per_strain * Eigen::SelfAdjointEigenSolver<Matrix6d>(expected).eigenvalues()[0];
  EXPECT_NEAR(softest->stiffness, least, 1e-6 * per_strain * expected.norm());
  const VectorXd force = matrix * softest->step;
  const Index particles = 6 * Index{packing.size()};
  EXPECT_LE(force.head(particles).norm(), 1e-6 * force.tail(6).norm()) << "particles do not follow";
  EXPECT_NEAR(softest->step.dot(force), softest->stiffness, 1e-6 * per_strain * expected.norm());
}

TEST_P(Strict, StatesOfAVariableCellAreStrictlyJammed) {
  const JamResult& result = free_states(GetParam(), count);
  ASSERT_EQ(result.status, JamStatus::jammed);
  for (const Packing& packing : result.states) {
    const Evaluation here = PackingEnergy().evaluate(packing, Precision::double_double);
    const Stability stability = strict_stability(packing, here, Precision::double_double);
    EXPECT_LE(deviator_of(here), 1e-6);
    EXPECT_EQ(stability.verdict, Verdict::stable) << packing.density();
    EXPECT_EQ(stability.zero, 3);
  }
}

TEST_P(Strict, ARelaxedCellIsStrictlyJammedAndRelaxesNoFurther) {
  const JamResult& result = jammed(GetParam(), count, .02, 2);
  const JamStep& step = result.path[static_cast<std::size_t>(result.state_steps.back())];
  const FreedCell freed = free_cell(result.states.back(), distance_to_jamming(step));
  std::printf("strain %.2e, phi %.5f from %.5f, deviator %.1e from %.1e, %d descents\n", freed.strain, freed.density,
              step.density, freed.deviator, step.deviator, freed.result.descents);
  ASSERT_TRUE(is_equilibrium(freed.result.summary));
  EXPECT_EQ(freed.result.stability.verdict, Verdict::stable);
  EXPECT_LE(freed.deviator, 1e-6);
  EXPECT_NEAR(freed.pressure, step.pressure, 1e-6 * step.pressure);
  EXPECT_GT(freed.strain, 1e-5);
  EXPECT_LT(freed.strain, .1);
  const FreedCell again = free_cell(freed.result.packing, distance_to_jamming(step));
  EXPECT_LE(again.strain, 1e-6);
}

TEST(StrictTest, APackingStableOnlyInAFixedCellIsDistinguished) {
  // A simple cubic lattice of cubes, each overlapping six others. Rows of cubes can slide along each other.
  Packing lattice{platonic(SolidKind::cube), PeriodicCell(4 * .98), {}};
  for (int k = 0; k < 64; ++k) {
    Pose pose;
    const Eigen::Vector3i place(k % 4, k / 4 % 4, k / 16);
    pose.position = .98 * place.cast<double>();
    lattice.poses.push_back(pose);
  }
  const Evaluation here = PackingEnergy().evaluate(lattice);
  ASSERT_GT(here.pressure, 0);
  EXPECT_LE(deviator_of(here), 1e-12);
  const Stability stability = strict_stability(lattice, here, Precision::working);
  EXPECT_NE(stability.verdict, Verdict::stable);
  EXPECT_GT(stability.zero + stability.negative, 3);
}

}  // namespace
}  // namespace isojam
