// Reference: central differences.

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <sstream>

#include "engine/packing/energy.hpp"
#include "tests/engine/packing/packings.hpp"

namespace isojam {
namespace {

using namespace testing_packings;
using Eigen::Matrix3d;
using Eigen::Vector3d;
using Eigen::VectorXd;

constexpr int particles = 70;
constexpr double density = .7;

using Evaluate = std::function<Evaluation(const Packing&)>;

Evaluation evaluate(const Packing& packing) { return PackingEnergy().evaluate(packing); }

/// Description of the deviation of the gradient along `direction`; empty if there is none.
std::string slope_disagreement(const Packing& packing, const VectorXd& direction, const Evaluate& evaluation) {
  const double h = 1e-5;  // far less than the depths of the contacts
  const Evaluation here = evaluation(packing);
  const double slope = here.gradient.dot(direction);
  const double differences =
      (evaluation(moved(packing, h * direction)).energy - evaluation(moved(packing, -h * direction)).energy) / (2 * h);
  // The third derivatives of E are of the order of V and S, like the gradient. The error of the differences is
  // therefore h² times the gradient, plus the rounding error divided by h.
  const double limit = 1e-7 * here.gradient.norm() * direction.norm() + energy_tolerance(here) / h;
  if (std::abs(slope - differences) <= limit) return "";
  std::ostringstream text;
  text << describe(packing) << ": slope " << slope << ", differences " << differences << ", allowed " << limit;
  return text.str();
}

TEST(EnergyDerivativesTest, GradientIsThatOfTheEnergy) {
  RandomStream random{21};
  for (const Packing& packing : samples(21, particles, density)) {
    for (int k = 0; k < 6; ++k)
      EXPECT_EQ(slope_disagreement(packing, random_step(random, particles), evaluate), "") << "direction " << k;
    for (int k = 0; k < 24; ++k) {
      const int coordinate = 6 * ((11 * k) % particles) + k % 6;
      EXPECT_EQ(slope_disagreement(packing, VectorXd::Unit(6 * particles, coordinate), evaluate), "")
          << "coordinate " << coordinate;
    }
  }
}

TEST(EnergyDerivativesTest, WrongGradientsAreDetected) {
  RandomStream random{22};
  const Packing packing = sample(SolidKind::tetrahedron, particles, density, 22);
  const auto slip = [](int first) {
    return [first](const Packing& p) {
      Evaluation wrong = evaluate(p);
      for (int i = 0; i < p.size(); ++i) wrong.gradient.segment<3>(6 * i + first) *= -1;
      return wrong;
    };
  };
  for (int k = 0; k < 6; ++k) {
    const VectorXd direction = random_step(random, particles);
    EXPECT_NE(slope_disagreement(packing, direction, slip(0)), "") << "forces of the wrong sign passed";
    EXPECT_NE(slope_disagreement(packing, direction, slip(3)), "") << "torques of the wrong sign passed";
  }
}

TEST(EnergyDerivativesTest, PressureIsTheSlopeInTheVolume) {
  for (const Packing& packing : samples(23, particles, density)) {
    const Evaluation here = evaluate(packing);
    const double phi = packing.density(), h = 1e-5 * phi;
    const double above = evaluate(strained_to(packing, phi + h)).energy;
    const double below = evaluate(strained_to(packing, phi - h)).energy;
    const double by_density = (above - below) / (2 * h);
    const double by_volume = (above - below) / (particles / (phi + h) - particles / (phi - h));
    const double limit = 1e-7 * here.pressure;
    EXPECT_GT(here.pressure, 0) << describe(packing);
    EXPECT_NEAR(here.pressure, -by_volume, limit) << describe(packing);
    EXPECT_NEAR(particles * here.pressure / (phi * phi), by_density, limit * particles / (phi * phi))
        << describe(packing);
  }
}

/// Energy of the contacts if their displacements are strained by ε and the orientations do not change.
double strained_energy(const Packing& packing, const std::vector<Contact>& contacts, const Matrix3d& strain) {
  double energy = 0;
  for (const Contact& contact : contacts) {
    const Vector3d d = contact.displacement + strain * contact.displacement;
    const Overlap o = relative_overlap(
        packing.solids.only(), packing.solids.only(),
        relative_pose(packing.poses[contact.pair.a].orientation, packing.poses[contact.pair.b].orientation, d));
    energy += o.volume * o.volume / 4;
  }
  return energy;
}

TEST(EnergyDerivativesTest, StressIsTheSlopeInEveryStrain) {
  for (const Packing& packing : samples(24, particles, density)) {
    PackingEnergy energy;
    const Evaluation here = energy.evaluate(packing);
    const std::vector<Contact> contacts = energy.contacts(packing);
    EXPECT_NEAR(strained_energy(packing, contacts, Matrix3d::Zero()), here.energy, energy_tolerance(here));
    const double h = 1e-5;
    Matrix3d differences;
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) {
        Matrix3d strain = Matrix3d::Zero();
        strain(i, j) = h;
        differences(i, j) = (strained_energy(packing, contacts, strain) - strained_energy(packing, contacts, -strain)) /
                            (2 * h * packing.cell.volume());
      }
    }
    EXPECT_LE((here.stress - differences).cwiseAbs().maxCoeff(), 1e-7 * here.stress.norm()) << describe(packing) << "\n"
                                                                                            << here.stress << "\n"
                                                                                            << differences;
  }
}

/// The antisymmetric part of the derivative of the gradient with respect to rotations: ½ θ×T.
VectorXd turned_gradient(const Packing& packing, const VectorXd& gradient, const VectorXd& direction) {
  VectorXd result = VectorXd::Zero(direction.size());
  for (int i = 0; i < packing.size(); ++i) {
    const Vector3d theta = direction.segment<3>(6 * i + 3) / packing.solids.only().gyration_radius();
    result.segment<3>(6 * i + 3) = theta.cross(gradient.segment<3>(6 * i + 3)) / 2;
  }
  return result;
}

TEST(EnergyDerivativesTest, HessianIsTheDerivativeOfTheGradient) {
  RandomStream random{25};
  for (const Packing& packing : samples(25, particles, density)) {
    PackingEnergy energy;
    const BlockMatrix hessian = energy.hessian(packing);
    const VectorXd gradient = energy.evaluate(packing).gradient;
    const double h = 1e-6;
    for (int k = 0; k < 16; ++k) {
      const VectorXd direction = k < 4 ? random_step(random, particles)
                                       : VectorXd::Unit(6 * particles, 6 * ((13 * k) % particles) + k % 6).eval();
      const VectorXd product = hessian * direction + turned_gradient(packing, gradient, direction);
      const VectorXd differences = (energy.evaluate(moved(packing, h * direction)).gradient -
                                    energy.evaluate(moved(packing, -h * direction)).gradient) /
                                   (2 * h);
      // The second derivative of V is continuous but has kinks, and some contact is always near a kink.
      EXPECT_LE((product - differences).norm(), 1e-5 * product.norm())
          << describe(packing) << ", direction " << k << ", |Hd| " << product.norm();
    }
  }
}

TEST(EnergyDerivativesTest, TranslationsAreNullVectorsOfTheHessian) {
  for (const Packing& packing : samples(26, particles, density)) {
    const BlockMatrix hessian = PackingEnergy().hessian(packing);
    for (int c = 0; c < 3; ++c) {
      VectorXd shift = VectorXd::Zero(6 * particles);
      for (int i = 0; i < particles; ++i) shift[6 * i + c] = 1;
      EXPECT_LE((hessian * shift).norm(), 1e-12 * dense(hessian).norm()) << describe(packing) << ", axis " << c;
    }
  }
}

}  // namespace
}  // namespace isojam
