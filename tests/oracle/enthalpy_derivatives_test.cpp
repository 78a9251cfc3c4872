// Reference: differences in quadruple precision.

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <array>
#include <cmath>
#include <cstdio>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

#include "engine/packing/cell/strain.hpp"
#include "engine/packing/enthalpy.hpp"
#include "tests/oracle/quad_packing.hpp"

namespace isojam::oracle {
namespace {

using Eigen::VectorXd;

constexpr int particles = 70;
constexpr Cohesion cohesion{0.1, 3e-3};

/// Numbers of the compositions: the five solids, and a mixture.
constexpr std::size_t compositions = all_solids.size() + 1;

/// Particles of unit volume, or a mixture of three shapes whose volumes differ by a factor of two.
std::vector<Particle> particles_of(std::size_t composition) {
  std::vector<Particle> list;
  for (int i = 0; i < particles; ++i) {
    if (composition < all_solids.size()) {
      list.push_back({&platonic(all_solids[composition]), 1, 0});
    } else {
      const SolidKind kind = std::array{SolidKind::tetrahedron, SolidKind::cube, SolidKind::dodecahedron}[i % 3];
      list.push_back({&platonic(kind), std::cbrt(i % 2 == 0 ? 2.0 / 3 : 4.0 / 3), i % 3});
    }
  }
  return list;
}

std::string name_of(std::size_t composition) {
  return composition < all_solids.size() ? std::string(to_string(all_solids[composition])) : "mixture";
}

/// A random packing in a cell that is sheared and stretched at random, but not too small.
Packing skewed(std::size_t composition, std::uint64_t seed) {
  RandomStream random{81, seed, composition};
  const Packing packing = random_packing(particles_of(composition), .55, random);
  while (true) {
    DoubleDoubleMatrix f;
    for (int r = 0; r < 3; ++r) {
      for (int c = 0; c < 3; ++c)
        f.set(r, c, DoubleDouble(f.high(r, c) + .12 * random.normal()) + 1e-18 * random.normal());
    }
    if (f.high.determinant() <= .9 || f.high.determinant() > 1.2) continue;
    const Packing candidate = deformed(packing, f);
    if (is_legal(candidate.cell, grown(candidate.solids, particles, cohesion.range / 2).widest())) return candidate;
  }
}

VectorXd random_direction(RandomStream& random, Eigen::Index size) {
  VectorXd direction(size);
  for (double& x : direction) x = random.normal();
  return direction.normalized();
}

/// The cell, and true if there is cohesion.
using Parameters = std::tuple<CellFreedom, bool>;

struct Case {
  Packing packing;
  Enthalpy enthalpy;
  VectorXd along;
  std::optional<Cohesion> cohesion;

  PackingEnergy energy() const { return cohesion ? PackingEnergy(*cohesion) : PackingEnergy(); }
};

Case a_case(std::size_t composition, const Parameters& parameters, std::uint64_t seed) {
  const auto [cell, is_cohesive] = parameters;
  RandomStream random{82, seed, static_cast<std::uint64_t>(cell)};
  const Packing packing = skewed(composition, seed);
  const CellControl control{cell, frees_volume(cell) ? 3e-3 : 0};
  const VectorXd along = random_direction(random, 6 * particles + strain_basis(cell).cols());
  return {packing, Enthalpy(control, packing.cell), along, is_cohesive ? std::optional(cohesion) : std::nullopt};
}

/// The enthalpy H in quadruple precision.
Quad quad_enthalpy(const Case& at, const Packing& packing) {
  const Quad volume = widened(packing.cell.volume_double_double());
  return evaluate_in_quad(packing, at.cohesion).energy + Quad(at.enthalpy.control().pressure) * volume;
}

/// The gradient of H in quadruple precision, in the coordinates of moved().
std::vector<Quad> quad_gradient(const Case& at, const Packing& packing) {
  return gradient_of(evaluate_in_quad(packing, at.cohesion), packing, at.enthalpy.control());
}

/// Terms of the derivative of the gradient along moved() that the Hessian does not contain. For rotations it is ½ θ×T,
/// because rotations do not commute. For strains it is the work of forces and of the antisymmetric stress during the
/// step. All these terms vanish in equilibrium.
VectorXd out_of_balance(const Case& at, const Evaluation& here) {
  const Packing& packing = at.packing;
  VectorXd result = VectorXd::Zero(at.along.size());
  Eigen::Matrix3d virial = Eigen::Matrix3d::Zero();
  for (int i = 0; i < packing.size(); ++i) {
    const Eigen::Vector3d theta = at.along.segment<3>(6 * i + 3) / packing.solids[i].gyration_radius();
    const Eigen::Vector3d slope = here.gradient.segment<3>(6 * i), torque = here.gradient.segment<3>(6 * i + 3);
    result.segment<3>(6 * i + 3) = theta.cross(torque) / 2;
    virial += slope * at.along.segment<3>(6 * i).transpose();
  }
  const StrainBasis basis = strain_basis(at.enthalpy.control().cell);
  const Eigen::Index strains = basis.cols();
  if (strains == 0) return result;
  const double length = strain_length(particles);
  const Eigen::Matrix3d strain = strain_tensor(basis * at.along.tail(strains) / length);
  const Eigen::Matrix3d turning = packing.cell.volume() * (here.stress - here.stress.transpose()) / 2;
  virial += turning * strain;
  result.tail(strains) = basis.transpose() * strain_components(virial) / length;
  return result;
}

class EnthalpyDerivatives : public testing::TestWithParam<Parameters> {};

std::string text(const Parameters& parameters) {
  return std::string(to_string(std::get<0>(parameters))) + (std::get<1>(parameters) ? "_with_cohesion" : "");
}

TEST_P(EnthalpyDerivatives, GradientIsThatOfTheEnthalpy) {
  const double h = 1e-9;
  for (std::size_t composition = 0; composition < compositions; ++composition) {
    const Case at = a_case(composition, GetParam(), 1);
    const Quad forth = quad_enthalpy(at, moved(at.packing, h * at.along)),
               back = quad_enthalpy(at, moved(at.packing, -h * at.along));
    const auto by_differences = static_cast<double>((forth - back) / (2 * Quad(h)));
    const std::vector<Quad> exact = quad_gradient(at, at.packing);
    for (const Precision precision : {Precision::working, Precision::double_double}) {
      const Evaluation here = at.enthalpy.of(at.energy().evaluate(at.packing, precision), at.packing);
      ASSERT_EQ(here.gradient.size(), at.along.size());
      EXPECT_NEAR(here.gradient.dot(at.along), by_differences, 1e-9 * here.gradient.norm()) << name_of(composition);
      for (Eigen::Index k = 0; k < here.gradient.size(); ++k)
        ASSERT_NEAR(here.gradient[k], static_cast<double>(exact[k]), 1e-12 * here.gradient.norm()) << k;
    }
  }
}

TEST_P(EnthalpyDerivatives, HessianIsThatOfTheGradient) {
  const double h = 1e-9;
  for (std::size_t composition = 0; composition < compositions; ++composition) {
    const Case at = a_case(composition, GetParam(), 2);
    const std::vector<Quad> forth = quad_gradient(at, moved(at.packing, h * at.along)),
                            back = quad_gradient(at, moved(at.packing, -h * at.along));
    VectorXd by_differences(at.along.size());
    for (Eigen::Index k = 0; k < by_differences.size(); ++k)
      by_differences[k] = static_cast<double>((forth[k] - back[k]) / (2 * Quad(h)));
    for (const Precision precision : {Precision::working, Precision::double_double}) {
      BlockMatrix hessian = at.energy().second_order(at.packing, 0, precision, std::get<0>(GetParam())).hessian;
      at.enthalpy.add_to(hessian, at.packing);
      const Evaluation here = at.enthalpy.of(at.energy().evaluate(at.packing, precision), at.packing);
      const VectorXd exact = hessian * at.along + out_of_balance(at, here);
      const double error = (exact - by_differences).norm() / by_differences.norm();
      const Eigen::Index strains = hessian.strains();
      const double of_cell = (exact.tail(strains) - by_differences.tail(strains)).norm();
      const double scale = by_differences.tail(strains).norm();
      std::printf("%-12s %-24s error %.1e, of strains %.1e of %.1e\n", name_of(composition).c_str(),
                  text(GetParam()).c_str(), error, of_cell, scale);
      EXPECT_LE(error, 1e-9) << name_of(composition);
      EXPECT_LE(of_cell, 1e-9 * scale) << name_of(composition);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(OfEveryCell, EnthalpyDerivatives,
                         testing::Combine(testing::Values(CellFreedom::fixed, CellFreedom::isotropic,
                                                          CellFreedom::shape, CellFreedom::free),
                                          testing::Bool()),
                         [](const auto& parameters) { return text(parameters.param); });

}  // namespace
}  // namespace isojam::oracle
