#include "engine/vibration/difference_modes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "engine/solve/factor/dense.hpp"
#include "engine/vibration/dynamical_matrix.hpp"
#include "tests/engine/solve/solve_support.hpp"
#include "tests/engine/vibration/jammed_states.hpp"

namespace isojam {
namespace {

using Eigen::VectorXd;

constexpr double eps = std::numeric_limits<double>::epsilon();

VectorXd exact_modes(const Packing& packing) {
  const BlockMatrix hessian = PackingEnergy().hessian(packing, Precision::double_double);
  return symmetric_eigenvalues(dense_matrix(dynamical_matrix(packing, hessian)));
}

Packing cubes_of_two_sizes() {
  RandomStream random{106};
  std::vector<Particle> particles;
  const double unit = std::cbrt(2 / (1 + std::pow(1.7, 3)));
  for (int i = 0; i < 80; ++i) particles.push_back({&platonic(SolidKind::cube), i % 2 ? unit : 1.7 * unit, i % 2});
  return random_packing(particles, 0.7, random);
}

TEST(DifferenceModes, AgreeWithTheAnalyticMatrix) {
  std::vector<Packing> cases{jammed(SolidKind::octahedron, 48, .01).states.front(), cubes_of_two_sizes()};
  for (const SolidKind kind : all_solids) cases.push_back(small_packing(kind, 0.7, 107));
  for (const Packing& packing : cases) {
    const VectorXd exact = exact_modes(packing);
    const VectorXd found = difference_modes(packing, 1e-8, Precision::double_double);
    ASSERT_EQ(found.size(), exact.size());
    const double lambda_max = exact.cwiseAbs().maxCoeff();
    const double worst = (found - exact).cwiseAbs().maxCoeff() / lambda_max;
    std::printf("%d particles: wrong by %.1e λ_max\n", packing.size(), worst);
    EXPECT_LE(worst, 1e-6);
    EXPECT_TRUE(std::is_sorted(found.begin(), found.end()));
    const auto nothing = 64 * eps * lambda_max;
    EXPECT_GE((found.array().abs() <= nothing).count(), 3);
  }
}

TEST(DifferenceModes, TranslationsAreProjectedOut) {
  const Packing& state = nearest_state(jammed(SolidKind::octahedron, 48, .01));
  const double lambda_max = exact_modes(state).maxCoeff();
  const auto zeros = [&](const VectorXd& lambda) { return (lambda.array().abs() <= 64 * eps * lambda_max).count(); };
  const double h = 1e-11;
  EXPECT_EQ(zeros(difference_modes(state, h, Precision::working)), 3);
  EXPECT_LT(zeros(symmetric_eigenvalues(difference_hessian(state, h, Precision::working))), 3);
}

TEST(DifferenceModes, LargeStepsGiveSpuriousNegativeModes) {
  const JamResult& result = jammed(SolidKind::octahedron, 48, .01);
  const Packing& state = nearest_state(result);
  const VectorXd exact = exact_modes(state);
  ASSERT_GT(exact[3], 0);
  const auto negative = [&](double h) {
    const VectorXd lambda = difference_modes(state, h, Precision::working);
    return (lambda.array() < -exact[3] / 2).count();
  };
  const auto large = negative(1e-3), middling = negative(1e-4), small = negative(1e-6);
  std::printf("negative of %d: %ld, %ld, %ld at h = 1e-3, 1e-4, 1e-6\n", 6 * state.size(), long(large), long(middling),
              long(small));
  EXPECT_GT(large, 0);
  EXPECT_GE(large, middling);
  EXPECT_GE(middling, small);
}

TEST(DifferenceModes, RejectInvalidSteps) {
  const Packing packing = small_packing(SolidKind::cube, 0.7, 108);
  EXPECT_THROW(difference_modes(packing, 0, Precision::working), std::invalid_argument);
}

}  // namespace
}  // namespace isojam
