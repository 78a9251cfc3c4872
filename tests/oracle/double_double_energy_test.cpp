// Reference: quadruple precision.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "engine/packing/energy.hpp"
#include "engine/solve/factor/block_cholesky.hpp"
#include "engine/solve/minimise/minimise.hpp"
#include "tests/oracle/quad_packing.hpp"

namespace isojam::oracle {
namespace {

using Eigen::Vector3d;
using Eigen::VectorXd;

constexpr int particles = 40;

double true_residual(const Packing& packing) { return static_cast<double>(evaluate_in_quad(packing).residual); }

/// States of octahedra, compressed beyond jamming and then decompressed until E/N < `least_energy`. Each state is
/// minimised after its strain step.
std::vector<Packing> jammed(double least_energy) {
  RandomStream random{70, 1};
  Packing packing = random_packing(platonic(SolidKind::octahedron), particles, .1, random);
  PackingEnergy energy;
  MinimiseOptions relax;
  relax.method = Method::lbfgs;
  relax.residual = 1e-3;
  relax.max_evaluations = 300;
  for (double density = .1; density < .78; density += .02) {
    packing = strained_to(packing, density);
    minimise(packing, energy, relax);
  }
  MinimiseOptions newton;
  newton.residual = 1e-7;
  std::vector<Packing> states;
  while (states.size() < 20) {
    minimise(packing, energy, newton);
    const Evaluation here = energy.evaluate(packing);
    states.push_back(packing);
    if (here.energy < least_energy * particles) break;
    // Δφ = 6E/(dE/dφ), because E ∝ Δφ⁶; dE/dφ = N p/φ².
    const double distance = 6 * here.energy * std::pow(packing.density(), 2) / (particles * here.pressure);
    packing = strained_to(packing, packing.density() - .35 * distance);
  }
  return states;
}

/// The state with the smallest residual among those of a few Newton steps.
Packing polished(Packing packing, Precision precision) {
  PackingEnergy energy;
  Packing best = packing;
  double least = energy.evaluate(packing, precision).residual;
  for (int k = 0; k < 5; ++k) {
    const BlockMatrix hessian = energy.hessian(packing, precision);
    double stiffest = 0;
    for (const Matrix6d& block : hessian.diagonal) stiffest = std::max(stiffest, block.diagonal().maxCoeff());
    BlockCholesky factor;
    double shift = 1e-15 * stiffest;
    while (!factor.factorise(hessian, shift)) shift *= 10;
    packing = moved(packing, -factor.solve(energy.evaluate(packing, precision).gradient));
    const double residual = energy.evaluate(packing, precision).residual;
    if (residual < least) least = residual, best = packing;
  }
  return best;
}

/// States from far above jamming to near it.
const std::vector<Packing>& states() {
  static const std::vector<Packing> made = jammed(5e-13);
  return made;
}

TEST(DoubleDoubleEnergy, ReachesResidualsThatDoubleDoesNot) {
  bool near = false;
  for (const Packing& start : states()) {
    const Packing in_double = polished(start, Precision::working),
                  polished_state = polished(start, Precision::double_double);
    const Evaluation here = PackingEnergy().evaluate(polished_state, Precision::double_double);
    const double reached = true_residual(polished_state), by_double = true_residual(in_double);
    Packing no_position = polished_state, no_orientation = polished_state;
    for (Pose& pose : no_position.poses) pose.position_low.setZero();
    for (Pose& pose : no_orientation.poses) pose.orientation_low.setZero();
    const double without_position = true_residual(no_position), without_orientation = true_residual(no_orientation);
    std::printf(
        "density %.3f, E/N %.1e, true residuals: %.1e; in double %.1e; without low parts of x %.1e, of q %.1e\n",
        start.density(), here.energy / start.size(), reached, by_double, without_position, without_orientation);
    EXPECT_LE(reached, 1e-10);
    EXPECT_LE(here.residual_floor, 1e-9);
    if (here.energy > 1e-11 * start.size()) continue;
    // Near jamming every low part is needed.
    near = true;
    EXPECT_GE(by_double, 1e-9);
    EXPECT_GE(without_position, 1e-9);
    EXPECT_GE(without_orientation, 1e-10);
    EXPECT_GE(PackingEnergy().evaluate(polished_state).residual, 1e-9) << "the plain evaluation cannot even see it";
  }
  EXPECT_TRUE(near);
}

VectorXd random_direction(RandomStream& random, int size = particles) {
  VectorXd direction(6 * size);
  for (double& x : direction) x = random.normal();
  return direction.normalized();
}

TEST(DoubleDoubleEnergy, FloorAndNoiseBoundTheErrors) {
  RandomStream random{70, 2};
  for (const Packing& start : states()) {
    const Packing rest = polished(start, Precision::double_double);
    // The remaining residual consists of rounding errors. A floor far above it would be useless.
    EXPECT_GE(true_residual(rest), 1e-3 * PackingEnergy().evaluate(rest, Precision::double_double).residual_floor);
    for (const double kick : {0.0, 1e-16, 1e-13, 1e-10, 1e-7}) {
      const Packing packing = moved(rest, kick * random_direction(random));
      const Evaluation here = PackingEnergy().evaluate(packing, Precision::double_double);
      const QuadEvaluation right = evaluate_in_quad(packing);
      EXPECT_EQ(here.contacts, right.contacts);
      EXPECT_LE(std::abs(static_cast<double>(Quad(here.energy) - right.energy)), here.energy_noise);
      // Rounding error of a large residual itself.
      const double error = std::abs(static_cast<double>(Quad(here.residual) - right.residual));
      EXPECT_LE(error, here.residual_floor + 1e-12 * here.residual)
          << "density " << start.density() << ", kick " << kick << ", residual " << here.residual;
    }
  }
}

/// The part of the derivative of the gradient that the symmetric Hessian does not contain, because rotations do not
/// commute: ½ θ×T.
VectorXd turned_gradient(const Packing& packing, const VectorXd& gradient, const VectorXd& direction) {
  VectorXd result = VectorXd::Zero(direction.size());
  for (int i = 0; i < packing.size(); ++i) {
    const Vector3d theta = direction.segment<3>(6 * i + 3) / packing.solids[i].gyration_radius();
    result.segment<3>(6 * i + 3) = theta.cross(Vector3d(gradient.segment<3>(6 * i + 3))) / 2;
  }
  return result;
}

TEST(DoubleDoubleEnergy, HessianIsTheDifferenceOfGradientsInQuadruplePrecision) {
  RandomStream random{70, 3};
  double worst = 0;
  for (const Packing& start : states()) {
    PackingEnergy energy;
    const BlockMatrix hessian = energy.hessian(start, Precision::double_double);
    const VectorXd gradient = energy.evaluate(start, Precision::double_double).gradient;
    for (int k = 0; k < 4; ++k) {
      const VectorXd direction =
          k < 2 ? random_direction(random) : VectorXd::Unit(6 * particles, 6 * (7 * k) + 3 * (k % 2)).eval();
      // The step is far below the depth of any contact, and far above the rounding of the state.
      const VectorXd differences =
          difference_of_gradients(start, direction, 1e-17) - turned_gradient(start, gradient, direction);
      const double error = (hessian * direction - differences).norm() / differences.norm();
      EXPECT_LE(error, 1e-9) << "density " << start.density() << ", direction " << k;
      worst = std::max(worst, error);
    }
  }
  std::printf("Hessian against differences in quadruple precision: largest relative error %.1e\n", worst);
}

/// A packing of three shapes in four sizes. The largest particle is seven times as large as the smallest.
Packing mixed_packing() {
  RandomStream random{70, 5};
  std::vector<Particle> list;
  double volume = 0;
  constexpr int count = 120;
  for (int i = 0; i < count; ++i) {
    constexpr std::array kinds{SolidKind::octahedron, SolidKind::cube, SolidKind::tetrahedron, SolidKind::octahedron};
    constexpr std::array sizes{1.0, 1.4, 0.6, 0.2};
    const int kind = i % 4;
    list.push_back({&platonic(kinds[static_cast<std::size_t>(kind)]), sizes[static_cast<std::size_t>(kind)], kind});
    volume += std::pow(list.back().scale, 3);
  }
  for (Particle& particle : list) particle.scale *= std::cbrt(count / volume);
  return random_packing(list, .8, random);
}

TEST(DoubleDoubleEnergy, MixturesAgreeWithQuadruplePrecision) {
  RandomStream random{70, 6};
  const Packing packing = mixed_packing();
  PackingEnergy energy;
  const Evaluation here = energy.evaluate(packing, Precision::double_double);
  const QuadEvaluation right = evaluate_in_quad(packing);
  EXPECT_EQ(here.contacts, right.contacts);
  EXPECT_GT(here.contacts, packing.size());
  EXPECT_LE(std::abs(static_cast<double>(Quad(here.energy) - right.energy)), here.energy_noise);
  EXPECT_NEAR(here.residual, static_cast<double>(right.residual), 1e-12 * here.residual);
  const std::vector<Quad> gradient = gradient_of(right, packing);
  double worst_gradient = 0, worst_stress = 0, worst_hessian = 0;
  for (Eigen::Index k = 0; k < here.gradient.size(); ++k)
    worst_gradient = std::max(worst_gradient, std::abs(static_cast<double>(Quad(here.gradient[k]) - gradient[k])));
  worst_gradient /= here.gradient.norm();
  for (int r = 0; r < 3; ++r) {
    for (int c = 0; c < 3; ++c)
      worst_stress = std::max(
          worst_stress,
          std::abs(static_cast<double>(Quad(here.stress(r, c) * packing.cell.volume()) -
                                       right.virial[static_cast<std::size_t>(r)][static_cast<std::size_t>(c)])));
  }
  worst_stress /= here.pressure * packing.cell.volume();
  const BlockMatrix hessian = energy.hessian(packing, Precision::double_double);
  for (int k = 0; k < 4; ++k) {
    const VectorXd direction = random_direction(random, packing.size());
    const VectorXd differences =
        difference_of_gradients(packing, direction, 1e-17) - turned_gradient(packing, here.gradient, direction);
    worst_hessian = std::max(worst_hessian, (hessian * direction - differences).norm() / differences.norm());
  }
  std::printf("mixture against quadruple precision: gradient %.1e, stress %.1e, Hessian %.1e\n", worst_gradient,
              worst_stress, worst_hessian);
  EXPECT_LE(worst_gradient, 1e-14);
  EXPECT_LE(worst_stress, 1e-13);
  EXPECT_LE(worst_hessian, 1e-9);
}

}  // namespace
}  // namespace isojam::oracle
