#include "engine/solve/factor/shift_invert.hpp"

#include <Spectra/SymEigsShiftSolver.h>
#include <limits>
#include <stdexcept>

#include "engine/solve/factor/dense.hpp"
#include "engine/solve/minimise/minimise.hpp"
#include "tests/engine/solve/solve_support.hpp"

namespace isojam {
namespace {

constexpr double eps = std::numeric_limits<double>::epsilon();

Eigen::VectorXd eigenvalues_of(const BlockMatrix& matrix) { return symmetric_eigenvalues(dense(matrix)); }

/// ‖(H − σ·1) y − x‖ / (‖H − σ·1‖ ‖y‖) for one random x.
double backward_error(const ShiftInvert& operation, const BlockMatrix& matrix, double sigma, double norm,
                      RandomStream& random) {
  const Eigen::VectorXd x = normal_vector(operation.rows(), random);
  Eigen::VectorXd y(x.size());
  operation.perform_op(x.data(), y.data());
  return (matrix * y - sigma * y - x).norm() / ((norm + std::abs(sigma)) * y.norm());
}

TEST(ShiftInvert, SolvesAndCountsOnBothSidesOfAnyEigenvalue) {
  RandomStream random{41};
  for (const SolidKind kind : all_solids) {
    const BlockMatrix matrix = PackingEnergy().hessian(small_packing(kind, 0.6, 5));
    const Eigen::VectorXd lambda = eigenvalues_of(matrix);
    const Eigen::Index n = lambda.size();
    const double norm = lambda.cwiseAbs().maxCoeff();
    ShiftInvert operation(matrix);
    ASSERT_EQ(operation.rows(), n);
    ASSERT_EQ(operation.cols(), n);
    for (const Eigen::Index below : {Eigen::Index{0}, Eigen::Index{1}, n / 3, n / 2, n - 1, n}) {
      const double low = below > 0 ? lambda[below - 1] : lambda[0] - norm;
      const double high = below < n ? lambda[below] : lambda[n - 1] + norm;
      if (high - low < 1e-6 * norm) continue;  // several eigenvalues are almost equal
      const double sigma = (low + high) / 2;
      operation.set_shift(sigma);
      EXPECT_EQ(operation.negative_pivots(), below) << platonic(kind).name() << " σ " << sigma;
      EXPECT_EQ(operation.positive_definite(), below == 0) << platonic(kind).name() << " σ " << sigma;
      // There is no pivoting, so pivots can be small, and the error grows by their ratio. This limit is valid if all
      // eigenvalues differ from σ by at least 1e-6 of the largest one.
      EXPECT_LE(backward_error(operation, matrix, sigma, norm, random), 1e6 * eps) << platonic(kind).name();
    }
  }
}

TEST(ShiftInvert, RejectsSingularMatrices) {
  BlockMatrix zero;
  zero.diagonal.assign(3, Matrix6d::Zero());
  ShiftInvert operation(zero);
  EXPECT_THROW(operation.set_shift(0), std::domain_error);
  operation.set_shift(1);
  EXPECT_EQ(operation.negative_pivots(), 18);
  operation.set_shift(-1);
  EXPECT_EQ(operation.negative_pivots(), 0);
  EXPECT_TRUE(operation.positive_definite());
  zero.diagonal[1](2, 2) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(operation.set_shift(1), std::domain_error);
}

/// Largest difference from the dense solver among the `wanted` lowest eigenvalues, divided by the highest eigenvalue.
double worst_mode(const BlockMatrix& matrix, int wanted, bool& positive_definite) {
  const Eigen::VectorXd lambda = eigenvalues_of(matrix);
  const double highest = lambda.maxCoeff();
  ShiftInvert operation(matrix);
  Spectra::SymEigsShiftSolver<ShiftInvert> solver(operation, wanted, 3 * wanted, -1e-9 * highest);
  positive_definite = operation.positive_definite();
  solver.init();
  EXPECT_EQ(solver.compute(Spectra::SortRule::LargestMagn, 1000, 1e-12, Spectra::SortRule::SmallestAlge), wanted);
  return (solver.eigenvalues() - lambda.head(wanted)).cwiseAbs().maxCoeff() / highest;
}

TEST(ShiftInvert, GivesSpectraTheLowestModesOfAnEquilibrium) {
  for (const SolidKind kind : {SolidKind::octahedron, SolidKind::dodecahedron}) {
    Packing packing = small_packing(kind, over_compressed(kind), 6, 48);
    PackingEnergy energy;
    ASSERT_TRUE(is_equilibrium(minimise(packing, energy, {})));
    bool positive_definite = false;
    const double worst = worst_mode(energy.hessian(packing), 23, positive_definite);
    EXPECT_TRUE(positive_definite) << "translations only cost nothing, and the shift is below them";
    // The error of each solver can be ε times the highest eigenvalue for each of the 6N coordinates.
    EXPECT_LE(worst, 2 * 6 * packing.size() * eps) << platonic(kind).name();
    std::printf("%s: lowest modes as the dense solver's to %.2g of the highest\n", platonic(kind).name().data(), worst);
  }
}

}  // namespace
}  // namespace isojam
