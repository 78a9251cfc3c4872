#include "engine/vibration/dynamical_matrix.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "engine/solve/factor/dense.hpp"
#include "engine/vibration/spectrum.hpp"
#include "tests/engine/solve/solve_support.hpp"
#include "tests/engine/vibration/jammed_states.hpp"

namespace isojam {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double eps = std::numeric_limits<double>::epsilon();

VectorXd spectrum(const MatrixXd& matrix) { return symmetric_eigenvalues(matrix); }

TEST(DynamicalMatrix, FormsAgree) {
  RandomStream random{51};
  for (const SolidKind kind : all_solids) {
    const BlockMatrix blocks = PackingEnergy().hessian(small_packing(kind, 0.7, 51));
    const MatrixXd full = dense_matrix(blocks);
    const VectorXd u = normal_vector(full.rows(), random);
    const double scale = norm_bound(blocks) * u.norm();
    EXPECT_LE((full * u - blocks * u).norm(), 8 * eps * scale) << to_string(kind);
    EXPECT_EQ(full, full.transpose()) << "rounding apart, and the blocks hold one half only";
    const double largest = spectrum(full).cwiseAbs().maxCoeff();
    EXPECT_LE(largest, norm_bound(blocks) * (1 + 64 * eps));
    EXPECT_GE(largest, norm_bound(blocks) / 12) << "a bound, not a guess";
  }
}

/// Solves H m = λ M m, where M contains the masses a³ and moments of inertia a⁵/6 of cubes of two sizes a.
TEST(DynamicalMatrix, OfMixturesHasTheirMasses) {
  RandomStream random{56};
  std::vector<Particle> particles;
  const double unit = std::cbrt(2 / (1 + std::pow(1.7, 3)));
  for (int i = 0; i < 100; ++i) particles.push_back({&platonic(SolidKind::cube), i % 2 ? unit : 1.7 * unit, i % 2});
  const Packing packing = random_packing(particles, 0.8, random);
  const BlockMatrix hessian = PackingEnergy().hessian(packing), matrix = dynamical_matrix(packing, hessian);
  VectorXd mass(6 * packing.size());
  double lightest = 1;
  for (int i = 0; i < packing.size(); ++i) {
    const double a = packing.solids[static_cast<std::size_t>(i)].scale();
    const double radius = packing.solids[static_cast<std::size_t>(i)].gyration_radius();
    mass.segment<3>(6 * i).setConstant(a * a * a);
    mass.segment<3>(6 * i + 3).setConstant(std::pow(a, 5) / 6 / (radius * radius));
    lightest = std::min(lightest, a * a * a);
  }
  EXPECT_NEAR(greatest_inverse_mass(packing), 1 / lightest, 1e-13 / lightest);
  const SymmetricEigen modes = symmetric_eigen(dense_matrix(matrix));
  const MatrixXd moves = mode_displacements(packing, modes.vectors);
  const MatrixXd full = dense_matrix(hessian);
  const double scale = modes.values.cwiseAbs().maxCoeff();
  for (Eigen::Index k = 0; k < moves.cols(); ++k) {
    const VectorXd left = full * moves.col(k), right = modes.values[k] * mass.cwiseProduct(moves.col(k));
    EXPECT_LE((left - right).norm(), 1e-12 * scale * mass.maxCoeff()) << "mode " << k;
  }
  const MatrixXd still = translations(matrix);
  EXPECT_LE((still.transpose() * still - MatrixXd::Identity(3, 3)).norm(), 64 * eps);
  for (int c = 0; c < 3; ++c) EXPECT_LE((matrix * still.col(c)).norm(), rounding_bound(matrix, scale));
  // The Lanczos method removes translations with the same masses. Its lowest and highest modes agree with the dense
  // solver.
  const SpectrumEnds ends = spectrum_ends(matrix);
  const ModeSet dense = dense_modes(matrix);
  EXPECT_NEAR(ends.lambda_max, modes.values.maxCoeff(), 1e-10 * scale);
  for (Eigen::Index k = 0; k < std::min<Eigen::Index>(4, ends.lowest.size()); ++k)
    EXPECT_NEAR(ends.lowest.eigenvalues[k], dense.eigenvalues[k], 1e-9 * scale) << k;
  EXPECT_LE((still.transpose() * ends.lowest.vectors).cwiseAbs().maxCoeff(), 1e5 * eps);
}

/// Solves H m = λ M m, where M is the mass matrix for (x, R·θ) from the moments of inertia of a box in its principal
/// axes.
TEST(DynamicalMatrix, OfBoxesHasTheirInertia) {
  RandomStream random{55};
  std::vector<Eigen::Vector3d> vertices;
  const Eigen::Vector3d edges = Eigen::Vector3d(1, 1.5, 2) / std::cbrt(3.0);
  for (int k = 0; k < 8; ++k)
    vertices.emplace_back(edges.cwiseProduct(Eigen::Vector3d(k & 1 ? 1 : 0, k & 2 ? 1 : 0, k & 4 ? 1 : 0)));
  const ConvexSolid box("box", vertices);
  const Packing packing = random_packing(box, least_particles(box, 0.8), 0.8, random);
  const Eigen::Vector3d moments = (Eigen::Vector3d::Constant(edges.squaredNorm()) - edges.cwiseAbs2()) / 12;
  const double mean = moments.mean();
  const BlockMatrix hessian = PackingEnergy().hessian(packing), matrix = dynamical_matrix(packing, hessian);
  const SymmetricEigen modes = symmetric_eigen(dense_matrix(matrix));
  const MatrixXd moves = mode_displacements(packing, modes.vectors);
  MatrixXd mass = MatrixXd::Identity(6 * packing.size(), 6 * packing.size());
  for (int i = 0; i < packing.size(); ++i) {
    const Eigen::Matrix3d q = packing.poses[static_cast<std::size_t>(i)].orientation.toRotationMatrix();
    mass.block<3, 3>(6 * i + 3, 6 * i + 3) = q * (moments / mean).asDiagonal() * q.transpose();
  }
  const MatrixXd rest = dense_matrix(hessian) * moves - mass * moves * modes.values.asDiagonal();
  EXPECT_LE(rest.norm(), 1e-12 * dense_matrix(hessian).norm());
  EXPECT_LE((moves.transpose() * mass * moves - MatrixXd::Identity(mass.rows(), mass.cols())).norm(), 1e-11);
  EXPECT_GT((dense_matrix(matrix) - dense_matrix(hessian)).norm(), .05 * dense_matrix(hessian).norm()) << "it matters";
  EXPECT_NEAR(greatest_inverse_mass(packing), mean / moments.minCoeff(), 1e-14);
}

}  // namespace
}  // namespace isojam
