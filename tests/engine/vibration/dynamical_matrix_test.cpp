#include "engine/vibration/dynamical_matrix.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>
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

const Packing& octahedra() { return nearest_state(jammed(SolidKind::octahedron, 48, .01)); }

/// Depth V/|S| of the shallowest contact, which is a face-face contact.
double shallowest_depth(const Packing& packing) {
  double least = packing.solids.only().inradius();
  for (const Contact& contact : PackingEnergy().contacts(packing))
    least = std::min(least, contact.overlap.volume / contact.overlap.area.norm());
  return least;
}

VectorXd spectrum(const MatrixXd& matrix) { return symmetric_eigenvalues(matrix); }

TEST(DynamicalMatrix, FormsAgree) {
  RandomStream random{51};
  for (const SolidKind kind : all_solids) {
    const BlockMatrix blocks = PackingEnergy().hessian(small_packing(kind, 0.7, 51));
    const MatrixXd full = dense_matrix(blocks);
    const VectorXd u = normal_vector(full.rows(), random);
    const double scale = norm_bound(blocks) * u.norm();
    EXPECT_LE((full * u - blocks * u).norm(), 8 * eps * scale) << to_string(kind);
    EXPECT_LE((sparse_matrix(blocks) * u - blocks * u).norm(), 8 * eps * scale) << to_string(kind);
    EXPECT_EQ(full, full.transpose()) << "rounding apart, and the blocks hold one half only";
    const double largest = spectrum(full).cwiseAbs().maxCoeff();
    EXPECT_LE(largest, norm_bound(blocks) * (1 + 64 * eps));
    EXPECT_GE(largest, norm_bound(blocks) / 12) << "a bound, not a guess";
  }
}

TEST(DynamicalMatrix, TranslationsAreNullVectors) {
  for (const SolidKind kind : all_solids) {
    const Packing packing = small_packing(kind, 0.7, 52);
    const BlockMatrix blocks = PackingEnergy().hessian(packing);
    const MatrixXd moves = translations(blocks);
    EXPECT_LE((moves.transpose() * moves - MatrixXd::Identity(3, 3)).norm(), 64 * eps);
    const double lambda_max = spectrum(dense_matrix(blocks)).cwiseAbs().maxCoeff();
    for (int c = 0; c < 3; ++c)
      EXPECT_LE((blocks * moves.col(c)).norm(), rounding_bound(blocks, lambda_max)) << to_string(kind);
    EXPECT_LE(rounding_bound(blocks, lambda_max), 1e4 * eps * lambda_max) << "it must still tell small from zero";
  }
  EXPECT_EQ(norm_bound(BlockMatrix{}), 0);
}

TEST(DynamicalMatrix, DifferencesBelowTheDepthOfFlatContacts) {
  const Packing& packing = octahedra();
  const BlockMatrix blocks = PackingEnergy().hessian(packing, Precision::double_double);
  const MatrixXd exact = dense_matrix(blocks);
  const double depth = shallowest_depth(packing), lowest = dense_modes(blocks).eigenvalues[0];
  double before = 1;
  for (const double h : {depth / 10, depth / 100}) {
    const MatrixXd differences = difference_hessian(packing, h);
    const double error = (differences - exact).norm() / exact.norm();
    const VectorXd lambda = spectrum(differences);
    std::printf("h %.1e, depth %.1e: differences wrong by %.1e of |D|, fourth mode %.2e, exact %.2e\n", h, depth, error,
                lambda[3], lowest);
    EXPECT_LE(error, 0.1 * h / depth) << "V'' of a contact changes by a part h/depth of itself at most";
    EXPECT_LT(error, before / 3);
    // Even if h is a tenth of the depth, a soft mode can be wrong.
    if (h < depth / 50) {
      EXPECT_NEAR(lambda[3], lowest, lowest / 10);
    }
    before = error;
  }
}

TEST(DynamicalMatrix, DifferencesAboveTheDepthGiveSpuriousModes) {
  const Packing& packing = octahedra();
  const BlockMatrix blocks = PackingEnergy().hessian(packing, Precision::double_double);
  const double depth = shallowest_depth(packing);
  const ModeSet exact = dense_modes(blocks);
  ASSERT_GT(exact.eigenvalues[0], rounding_bound(blocks, exact.eigenvalues[exact.size() - 1]));
  const double h = 1000 * depth;
  const VectorXd lambda = spectrum(difference_hessian(packing, h));
  const long negative = (lambda.array() < -exact.eigenvalues[0]).count();
  std::printf("h %.1e, depth %.1e: %ld negative modes\n", h, depth, negative);
  EXPECT_GE(negative, 1);
}

TEST(DynamicalMatrix, IsTheCurvatureOfTheEnergy) {
  RandomStream random{53};
  // Far from jamming, where contacts are deep.
  const Packing& packing = jammed(SolidKind::octahedron, 48, .01).states.front();
  PackingEnergy energy;
  const BlockMatrix blocks = energy.hessian(packing);
  const double here = energy.evaluate(packing).energy;
  for (int trial = 0; trial < 8; ++trial) {
    const VectorXd u = normal_vector(6 * packing.size(), random).normalized();
    const double h = 1e-4, quotient = u.dot(blocks * u);
    const double curvature =
        (energy.evaluate(moved(packing, h * u)).energy + energy.evaluate(moved(packing, -h * u)).energy - 2 * here) /
        (h * h);
    EXPECT_NEAR(curvature, quotient, 1e-4 * quotient) << "trial " << trial;
  }
}

TEST(DynamicalMatrix, OfSphericalTopsIsTheHessian) {
  const Packing packing = small_packing(SolidKind::octahedron, 0.7, 54);
  const BlockMatrix hessian = PackingEnergy().hessian(packing);
  EXPECT_EQ(dense_matrix(dynamical_matrix(packing, hessian)), dense_matrix(hessian));
  EXPECT_EQ(greatest_inverse_mass(packing), 1);
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

TEST(DynamicalMatrix, RejectsInvalidSteps) {
  EXPECT_THROW(difference_hessian(octahedra(), 0), std::invalid_argument);
  EXPECT_THROW(difference_hessian(octahedra(), -1e-6), std::invalid_argument);
}

}  // namespace
}  // namespace isojam
