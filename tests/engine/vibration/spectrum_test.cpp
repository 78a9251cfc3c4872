// Reference: a dense solver.

#include "engine/vibration/spectrum.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "engine/vibration/dynamical_matrix.hpp"
#include "tests/engine/solve/solve_support.hpp"
#include "tests/engine/vibration/jammed_states.hpp"

namespace isojam {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double eps = std::numeric_limits<double>::epsilon();

struct System {
  SolidKind kind;
  int n;
  double final_distance;
};

class Modes : public testing::TestWithParam<System> {
 protected:
  const JamResult& result = jammed(GetParam().kind, GetParam().n, GetParam().final_distance);
};

INSTANTIATE_TEST_SUITE_P(Systems, Modes,
                         testing::Values(System{SolidKind::octahedron, 48, .01},
                                         System{SolidKind::tetrahedron, 64, .02},
                                         System{SolidKind::icosahedron, 32, .01}),
                         [](const auto& test) { return std::string(to_string(test.param.kind)); });

BlockMatrix hessian_of(const Packing& packing) { return PackingEnergy().hessian(packing, Precision::double_double); }

void expect_eigenpairs(const BlockMatrix& matrix, const ModeSet& modes, double lambda_max, double tolerance) {
  const MatrixXd unity = MatrixXd::Identity(modes.size(), modes.size());
  EXPECT_LE((modes.vectors.transpose() * modes.vectors - unity).cwiseAbs().maxCoeff(), 1e4 * eps);
  EXPECT_LE((translations(matrix).transpose() * modes.vectors).cwiseAbs().maxCoeff(), 1e4 * eps);
  double worst = 0;
  for (Index k = 0; k < modes.size(); ++k) {
    const VectorXd u = modes.vectors.col(k);
    worst = std::max(worst, (matrix * u - modes.eigenvalues[k] * u).norm() / lambda_max);
    EXPECT_NEAR(u.dot(matrix * u), modes.eigenvalues[k], tolerance * lambda_max);
    if (k > 0) {
      EXPECT_GE(modes.eigenvalues[k], modes.eigenvalues[k - 1]);
    }
  }
  EXPECT_LE(worst, tolerance);
  EXPECT_NEAR(modes.residual, worst, 64 * eps);
}

TEST_P(Modes, AgreeWithTheDenseSolver) {
  const double allowed = GetParam().kind == SolidKind::tetrahedron ? 1e-6 : 1e-8;
  for (const Packing& state : result.states) {
    const BlockMatrix matrix = hessian_of(state);
    const SpectrumEnds ends = spectrum_ends(matrix);
    const ModeSet all = dense_modes(matrix);
    ASSERT_EQ(ends.lowest.ended, ModeEnd::converged) << to_string(ends.lowest.ended);
    ASSERT_EQ(ends.highest.ended, ModeEnd::converged) << to_string(ends.highest.ended);
    ASSERT_EQ(ends.lowest.size(), 50);
    ASSERT_EQ(ends.highest.size(), 50);
    ASSERT_EQ(all.size(), 6 * state.size() - 3);
    const VectorXd low = all.eigenvalues.head(50), high = all.eigenvalues.tail(50);
    const double at_low = ((ends.lowest.eigenvalues - low).array() / low.array()).abs().maxCoeff();
    const double at_high = ((ends.highest.eigenvalues - high).array() / high.array()).abs().maxCoeff();
    std::printf("λ %.1e … %.1e: lowest to %.1e, said to be %.1e; highest to %.1e, said %.1e; residual %.1e\n", low[0],
                high[49], at_low, ends.lowest.relative_error, at_high, ends.highest.relative_error,
                ends.lowest.residual);
    // The rounding error of an eigenvalue in double is relative to the largest eigenvalue.
    EXPECT_LE(at_low, std::max(allowed, 8 * eps * all.eigenvalues.tail(1)[0] / low[0]));
    EXPECT_LE(at_high, 1e-8);
    EXPECT_LE(at_low, ends.lowest.relative_error + all.relative_error);
    EXPECT_LE(at_high, ends.highest.relative_error + 1e3 * eps);
    EXPECT_EQ(ends.lambda_max, ends.highest.eigenvalues[49]);
    expect_eigenpairs(matrix, ends.lowest, ends.lambda_max, rounding_bound(matrix, ends.lambda_max) / ends.lambda_max);
    expect_eigenpairs(matrix, ends.highest, ends.lambda_max, 1e-8);
  }
}

TEST_P(Modes, HaveTheSameBitsAgain) {
  const BlockMatrix matrix = hessian_of(nearest_state(result));
  const SpectrumEnds once = spectrum_ends(matrix), again = spectrum_ends(matrix);
  EXPECT_EQ(once.lowest.eigenvalues, again.lowest.eigenvalues);
  EXPECT_EQ(once.lowest.vectors, again.lowest.vectors);
  EXPECT_EQ(once.highest.vectors, again.highest.vectors);
}

TEST(ModesTest, FindsTheLowestOfAnUnstableMatrix) {
  for (const SolidKind kind : all_solids) {
    const BlockMatrix matrix = hessian_of(small_packing(kind, 0.7, 61, 48));  // random, not a minimum
    const ModeSet all = dense_modes(matrix);
    ModeOptions options;
    options.lowest = options.highest = 20;
    const SpectrumEnds ends = spectrum_ends(matrix, options);
    const double lambda_max = all.eigenvalues.cwiseAbs().maxCoeff();
    const double worst = (ends.lowest.eigenvalues - all.eigenvalues.head(20)).cwiseAbs().maxCoeff();
    std::printf("%s: %ld negative modes, %s, lowest to %.1e of lambda_max\n", to_string(kind).data(),
                (all.eigenvalues.array() < 0).count(), to_string(ends.lowest.ended).data(), worst / lambda_max);
    ASSERT_EQ(ends.lowest.size(), 20);
    EXPECT_EQ(ends.lowest.ended, ModeEnd::retried) << "the shift near 0 sees other modes first";
    EXPECT_EQ(ends.lowest.attempts, 2);
    EXPECT_LE(worst, rounding_bound(matrix, lambda_max));
  }
}

TEST(ModesTest, FallsBackToTheDenseSolver) {
  const BlockMatrix matrix = hessian_of(nearest_state(jammed(SolidKind::icosahedron, 32, .01)));
  const ModeSet all = dense_modes(matrix);
  ModeOptions many;
  many.lowest = 1000;
  many.highest = 5;
  const SpectrumEnds asked_for_all = spectrum_ends(matrix, many);
  EXPECT_EQ(asked_for_all.lowest.ended, ModeEnd::dense_fallback);
  EXPECT_EQ(asked_for_all.lowest.eigenvalues, all.eigenvalues);
  EXPECT_EQ(asked_for_all.highest.eigenvalues, all.eigenvalues.tail(5));

  ModeOptions hasty;
  hasty.restarts = 0;
  hasty.lowest = hasty.highest = 10;
  hasty.highest_tolerance = hasty.lowest_tolerance = eps;
  const SpectrumEnds not_converged = spectrum_ends(matrix, hasty);
  EXPECT_EQ(not_converged.highest.ended, ModeEnd::dense_fallback) << to_string(not_converged.highest.ended);

  many.largest_dense = 31;
  const SpectrumEnds refused = spectrum_ends(matrix, many);
  EXPECT_EQ(refused.lowest.ended, ModeEnd::failed);
  EXPECT_FALSE(refused.complete());

  BlockMatrix without_contacts;
  without_contacts.diagonal.assign(24, Matrix6d::Zero());
  const SpectrumEnds free = spectrum_ends(without_contacts);
  EXPECT_EQ(free.lowest.ended, ModeEnd::dense_fallback);
  EXPECT_EQ(free.lowest.eigenvalues, VectorXd::Zero(50));
  EXPECT_EQ(free.lambda_max, 0);
}

TEST(ModesTest, FailsForNaN) {
  BlockMatrix matrix = hessian_of(small_packing(SolidKind::octahedron, 0.6, 63));
  matrix.diagonal[3](1, 1) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(spectrum_ends(matrix).lowest.ended, ModeEnd::failed);
  EXPECT_EQ(spectrum_ends(matrix).highest.ended, ModeEnd::failed);
  EXPECT_EQ(dense_modes(matrix).ended, ModeEnd::failed);
  EXPECT_EQ(dense_modes(BlockMatrix{}).ended, ModeEnd::failed);
  EXPECT_EQ(spectrum_ends(BlockMatrix{}).lowest.ended, ModeEnd::failed);
}

}  // namespace
}  // namespace isojam
