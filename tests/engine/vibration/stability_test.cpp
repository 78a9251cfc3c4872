// Reference: all 6N eigenvalues of a dense solver.

#include "engine/vibration/stability.hpp"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <limits>
#include <set>

#include "engine/vibration/dynamical_matrix.hpp"
#include "tests/engine/solve/solve_support.hpp"
#include "tests/engine/vibration/jammed_states.hpp"

namespace isojam {
namespace {

using Eigen::VectorXd;

struct Counts {
  long negative = 0, zero = 0, positive = 0;
};

/// Counts from all 6N eigenvalues, including those of translations, none of which is assumed to be zero.
Counts dense_counts(const BlockMatrix& matrix, double tolerance) {
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(dense(matrix), Eigen::EigenvaluesOnly);
  const auto lambda = solver.eigenvalues().array();
  return {(lambda < -tolerance).count(), (lambda.abs() <= tolerance).count(), (lambda > tolerance).count()};
}

void expect_counts(const Stability& stability, const BlockMatrix& matrix) {
  const Counts expected = dense_counts(matrix, stability.tolerance);
  EXPECT_EQ(stability.negative, expected.negative);
  EXPECT_EQ(stability.zero, expected.zero);
  EXPECT_EQ(stability.positive, expected.positive);
  EXPECT_LE(stability.translation_error, stability.tolerance);
}

TEST(StabilityTest, JammedStatesAreStrictMinima) {
  for (const JamResult* result : {&jammed(SolidKind::octahedron, 48, .01), &jammed(SolidKind::tetrahedron, 64, .02),
                                  &jammed(SolidKind::icosahedron, 32, .01)}) {
    for (const Packing& state : result->states) {
      PackingEnergy energy;
      const double torque = unbalanced_torque(energy.evaluate(state, Precision::double_double), state.solids);
      const BlockMatrix matrix = energy.hessian(state, Precision::double_double);
      const SpectrumEnds ends = spectrum_ends(matrix);
      const Stability stability = assess(matrix, ends, torque);
      std::printf(
          "%s φ %.4f: %s, zero %d, negative %d, lowest %.1e, tolerance %.1e, of which torque %.1e; near-rattlers",
          state.solids.only().name().data(), state.density(), to_string(stability.verdict).data(), stability.zero,
          stability.negative, ends.lowest.eigenvalues[0], stability.tolerance, torque);
      for (const NearRattler& found : stability.near_rattlers)
        std::printf(" %d (%s, %d contacts, %.1e)", found.particle, to_string(found.reason).data(), found.contacts,
                    found.least_eigenvalue);
      std::printf("\n");
      expect_counts(stability, matrix);
      EXPECT_EQ(stability.verdict, Verdict::stable);
      EXPECT_EQ(stability.zero, 3);
      EXPECT_EQ(stability.negative, 0);
      EXPECT_LT(stability.tolerance, ends.lowest.eigenvalues[0] / 10) << "zero and small must be told apart";
    }
  }
}

TEST(StabilityTest, CountsAreThoseOfTheDenseSolver) {
  for (const SolidKind kind : all_solids) {
    for (const double density : {0.3, 0.5, 0.7}) {
      const Packing packing = small_packing(kind, density, 81);
      const BlockMatrix matrix = PackingEnergy().hessian(packing);
      for (const bool with_modes : {true, false}) {
        const Stability stability = assess(matrix, with_modes ? spectrum_ends(matrix) : SpectrumEnds{});
        EXPECT_EQ(stability.verdict, Verdict::unstable) << to_string(kind) << " at " << density;
        EXPECT_GT(stability.negative, 0);
        expect_counts(stability, matrix);
      }
    }
  }
}

BlockMatrix jammed_matrix() {
  return PackingEnergy().hessian(nearest_state(jammed(SolidKind::octahedron, 48, .01)), Precision::double_double);
}

TEST(StabilityTest, NamesParticlesWithoutContacts) {
  BlockMatrix matrix = jammed_matrix();
  matrix.diagonal.push_back(Matrix6d::Zero());
  const Stability stability = assess(matrix, spectrum_ends(matrix));
  EXPECT_EQ(stability.verdict, Verdict::marginal);
  EXPECT_EQ(stability.zero, 9);
  EXPECT_EQ(stability.negative, 0);
  ASSERT_EQ(stability.near_rattlers.size(), 1U);
  EXPECT_EQ(stability.near_rattlers[0].particle, 48);
  EXPECT_EQ(stability.near_rattlers[0].contacts, 0);
  EXPECT_EQ(stability.near_rattlers[0].reason, NearRattler::Reason::few_contacts);
  EXPECT_EQ(stability.near_rattlers[0].least_eigenvalue, 0);
}

TEST(StabilityTest, NamesParticlesWithNegativeStiffness) {
  // One coordinate of a particle in a jammed packing gets a negative stiffness. If it is small, the neighbours
  // stabilise the particle; if it is large, they do not.
  const BlockMatrix matrix = jammed_matrix();
  for (const int particle : {0, 13, 47}) {
    BlockMatrix pushed = matrix;
    const Eigen::SelfAdjointEigenSolver<Matrix6d> block(matrix.diagonal[particle]);
    const Vector6d soft = block.eigenvectors().col(0);
    pushed.diagonal[particle] -= 2 * block.eigenvalues()[0] * soft * soft.transpose();
    for (const SpectrumEnds& ends : {spectrum_ends(pushed), SpectrumEnds{}}) {
      const Stability stability = assess(pushed, ends);
      EXPECT_GE(stability.negative, 1);
      EXPECT_EQ(stability.verdict, Verdict::unstable);
      const auto named = std::find_if(stability.near_rattlers.begin(), stability.near_rattlers.end(),
                                      [&](const NearRattler& found) { return found.particle == particle; });
      ASSERT_NE(named, stability.near_rattlers.end()) << "particle " << particle;
      EXPECT_LT(named->least_eigenvalue, 0);
      if (named->contacts >= 4) {
        EXPECT_EQ(named->reason, NearRattler::Reason::vanishing_stiffness);
      }
    }
  }
}

TEST(StabilityTest, NamesParticlesThatAreUnstableTogether) {
  // Particle 0 is stable while particle 1 is at rest. Together they are unstable, and particle 0 has most of the
  // amplitude.
  BlockMatrix matrix;
  matrix.diagonal.assign(8, 100 * Matrix6d::Identity());
  matrix.diagonal[0] = Matrix6d::Identity();
  matrix.off_diagonal.push_back({0, 1, 11 * Matrix6d::Identity()});
  for (int row = 0; row < 8; ++row) {
    for (int column = std::max(2, row + 1); column < 8; ++column)
      matrix.off_diagonal.push_back({row, column, Matrix6d::Zero()});
  }
  const Stability stability = assess(matrix, spectrum_ends(matrix));
  EXPECT_EQ(stability.negative, 6);
  ASSERT_EQ(stability.near_rattlers.size(), 1U);
  EXPECT_EQ(stability.near_rattlers[0].particle, 0);
  EXPECT_EQ(stability.near_rattlers[0].reason, NearRattler::Reason::vanishing_stiffness);
  EXPECT_NEAR(stability.near_rattlers[0].least_eigenvalue, 1, 1e-14);
  EXPECT_TRUE(assess(matrix, {}).near_rattlers.empty()) << "without modes nobody can tell";
}

TEST(StabilityTest, FewContacts) {
  BlockMatrix matrix;
  matrix.diagonal.assign(5, 4 * Matrix6d::Identity());
  for (const auto& [row, column] : {std::pair{0, 1}, {0, 2}, {0, 3}, {0, 4}, {1, 2}, {1, 3}, {1, 4}, {2, 3}})
    matrix.off_diagonal.push_back({row, column, -Matrix6d::Identity()});
  const Stability stability = assess(matrix, {});
  ASSERT_EQ(stability.near_rattlers.size(), 3U);
  EXPECT_EQ(stability.near_rattlers[0].particle, 2);
  EXPECT_EQ(stability.near_rattlers[0].contacts, 3);
  EXPECT_EQ(stability.near_rattlers[1].particle, 3);
  EXPECT_EQ(stability.near_rattlers[2].particle, 4);
  EXPECT_EQ(stability.near_rattlers[2].contacts, 2);
  EXPECT_NEAR(stability.near_rattlers[2].least_eigenvalue, 4, 1e-14);
}

TEST(StabilityTest, ToleranceIsRoundingAndTorque) {
  const BlockMatrix matrix = jammed_matrix();
  EXPECT_EQ(zero_tolerance(matrix, 2), rounding_bound(matrix, 2));
  EXPECT_EQ(zero_tolerance(matrix, 2, 0.25), rounding_bound(matrix, 2) + 0.25);
  Evaluation evaluation;
  evaluation.gradient = VectorXd::Zero(12);
  evaluation.gradient.segment<3>(9) << 0, 3, -4;  // torque/R of the second particle
  evaluation.gradient.segment<3>(6) << 100, 0, 0;
  const ConvexSolid& cube = platonic(SolidKind::cube);
  EXPECT_EQ(unbalanced_torque(evaluation, cube), 5 / cube.gyration_radius());
  // A tolerance above some modes counts them as zero.
  const SpectrumEnds ends = spectrum_ends(matrix);
  const double between = (ends.lowest.eigenvalues[4] + ends.lowest.eigenvalues[5]) / 2;
  const Stability blurred = assess(matrix, ends, between);
  EXPECT_EQ(blurred.zero, 8);
  EXPECT_EQ(blurred.verdict, Verdict::marginal);
}

TEST(StabilityTest, NaNIsUndetermined) {
  BlockMatrix matrix = jammed_matrix();
  matrix.off_diagonal[5].value(2, 2) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(assess(matrix, {}).verdict, Verdict::undetermined);
  EXPECT_EQ(Stability().verdict, Verdict::not_called);
  std::set<std::string_view> names;
  for (int k = 0; k <= static_cast<int>(Verdict::undetermined); ++k) names.insert(to_string(static_cast<Verdict>(k)));
  EXPECT_EQ(names.size(), 5U);
}

}  // namespace
}  // namespace isojam
