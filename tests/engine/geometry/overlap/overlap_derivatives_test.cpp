// Reference: central differences. Tetrahedra have no inversion symmetry, which could hide wrong signs.

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <functional>
#include <sstream>

#include "engine/geometry/overlap/overlap.hpp"
#include "tests/engine/geometry/overlap/pairs.hpp"
#include "tests/oracle/own_hessian.hpp"

namespace isojam {
namespace {

using namespace testing_pairs;
using Eigen::Vector3d;
using oracle::skew;
using Vector12d = Eigen::Matrix<double, 12, 1>;
using Matrix12d = Eigen::Matrix<double, 12, 12>;

constexpr int cases = 4;  // per pair of solids
constexpr double least_volume = 1e-3, greatest_volume = .1;

Pair moved_by(const Pair& pair, const Vector12d& step) {
  Pair result = pair;
  result.a.position += step.segment<3>(0);
  result.a.orientation = rotated(pair.a.orientation, step.segment<3>(3));
  result.b.position += step.segment<3>(6);
  result.b.orientation = rotated(pair.b.orientation, step.segment<3>(9));
  return result;
}

Vector12d unit(int k) { return Vector12d::Unit(k); }

/// Values of V and of its derivatives with respect to (x_A, θ_A, x_B, θ_B) in the lab frame, which are checked.
struct Claim {
  double volume = 0;
  Vector12d gradient;
};
using Claimant = std::function<Claim(const Pair&)>;

/// The signs are those of S, of M and of the lever arm of B: 1, or −1 for an intended error.
Claim claim_with(const Pair& pair, double area_sign, double moment_sign, double lever_sign) {
  const Overlap result = overlap(pair);
  const Vector3d s = pair.a.orientation * result.area, m = pair.a.orientation * result.moment;
  Claim made;
  made.volume = result.volume;
  made.gradient.segment<3>(0) = area_sign * s;
  made.gradient.segment<3>(3) = moment_sign * m;
  made.gradient.segment<3>(6) = -area_sign * s;
  made.gradient.segment<3>(9) = -moment_sign * m + lever_sign * pair.displacement().cross(s);
  return made;
}

Claim claim(const Pair& pair) { return claim_with(pair, 1, 1, 1); }

/// Description of the differences between the gradient and central differences of V; empty if they agree.
std::string gradient_disagreement(const Pair& pair, const Claimant& claimant) {
  // The depths are at least about 0.05, so the step is small compared with every feature of the contact.
  const double h = 1e-5;
  const Claim here = claimant(pair);
  Vector12d differences;
  for (int k = 0; k < 12; ++k)
    differences[k] =
        (claimant(moved_by(pair, h * unit(k))).volume - claimant(moved_by(pair, -h * unit(k))).volume) / (2 * h);
  // The third derivatives of V are of the order of the lever arms, so the errors h² and ε/h are far below this limit.
  const double limit = 1e-7 * differences.norm();
  const double error = (differences - here.gradient).cwiseAbs().maxCoeff();
  if (error <= limit) return "";
  std::ostringstream text;
  text << "off by " << error << " where " << limit << " is allowed; claimed " << here.gradient.transpose()
       << "\ndifferences " << differences.transpose() << "\n"
       << describe(pair);
  return text.str();
}

template <class Check>
void for_each_contact(std::uint64_t seed, const Check& check) {
  RandomStream random{5, seed};
  for (const SolidKind a : all_solids) {
    for (const SolidKind b : all_solids) {
      for (int k = 0; k < cases; ++k) check(random_contact(random, a, b, least_volume, greatest_volume));
    }
  }
}

TEST(OverlapDerivativesTest, AreaAndMomentAreTheGradientOfVolume) {
  for_each_contact(1, [](const Pair& pair) { EXPECT_EQ(gradient_disagreement(pair, claim), ""); });
}

TEST(OverlapDerivativesTest, WrongGradientsAreDetected) {
  RandomStream random{5, 2};
  const auto slip = [](double area, double turn, double lever) {
    return [=](const Pair& pair) { return claim_with(pair, area, turn, lever); };
  };
  const auto wrong_volume = [](const Pair& pair) {
    Claim wrong = claim(pair);
    wrong.volume *= 1 + 1e-5;
    return wrong;
  };
  for (int k = 0; k < 25; ++k) {
    const Pair pair =
        random_contact(random, SolidKind::tetrahedron, SolidKind::tetrahedron, least_volume, greatest_volume);
    EXPECT_EQ(gradient_disagreement(pair, claim), "");
    EXPECT_NE(gradient_disagreement(pair, slip(1, -1, 1)), "") << "M of the wrong sign passed: " << describe(pair);
    EXPECT_NE(gradient_disagreement(pair, slip(1, 1, -1)), "") << "the lever passed: " << describe(pair);
    EXPECT_NE(gradient_disagreement(pair, slip(-1, 1, 1)), "") << "S passed: " << describe(pair);
    EXPECT_NE(gradient_disagreement(pair, wrong_volume), "") << "a wrong volume passed: " << describe(pair);
  }
}

/// The 12×12 Hessian of V from the engine, lab frame.
Matrix12d hessian(const Pair& pair) {
  const RelativePose pose = pair.relative();
  const Overlap result = overlap(pair);
  const Matrix6d cross = oracle::overlap_cross_hessian(pair.solid_a(), pair.solid_b(), pose);
  Matrix12d h;
  h << oracle::own_hessian(cross, result.area, pose.displacement), cross, cross.transpose(),
      oracle::own_hessian(cross.transpose(), -result.area, -pose.displacement);
  Matrix12d frame = Matrix12d::Zero();
  for (int k = 0; k < 12; k += 3) frame.block<3, 3>(k, k) = pair.a.orientation.toRotationMatrix();
  return frame * h * frame.transpose();
}

Matrix12d gradient_differences(const Pair& pair) {
  const double h = 1e-6;
  Matrix12d differences;
  for (int k = 0; k < 12; ++k)
    differences.col(k) =
        (claim(moved_by(pair, h * unit(k))).gradient - claim(moved_by(pair, -h * unit(k))).gradient) / (2 * h);
  return differences;
}

TEST(OverlapDerivativesTest, HessianIsTheDerivativeOfTheGradient) {
  for_each_contact(3, [](const Pair& pair) {
    const Matrix12d analytic = hessian(pair), differences = gradient_differences(pair);
    Matrix12d expected = analytic;
    // Rotations do not commute. The derivative of the torque with respect to rotations of the same body therefore has
    // the antisymmetric part −½ [torque]×.
    const Vector12d g = claim(pair).gradient;
    expected.block<3, 3>(3, 3) -= skew(g.segment<3>(3)) / 2;
    expected.block<3, 3>(9, 9) -= skew(g.segment<3>(9)) / 2;
    const double limit = 1e-6 * analytic.norm();
    EXPECT_LE((expected - differences).cwiseAbs().maxCoeff(), limit) << describe(pair) << "\nminus differences\n"
                                                                     << expected - differences;
    // Without the antisymmetric part the comparison must fail, because the contact is not in equilibrium.
    EXPECT_GT((analytic - differences).cwiseAbs().maxCoeff(), limit) << describe(pair);
  });
}

TEST(OverlapDerivativesTest, HessianIsSymmetric) {
  for_each_contact(4, [](const Pair& pair) {
    const Matrix12d h = hessian(pair);
    EXPECT_LE((h - h.transpose()).cwiseAbs().maxCoeff(), 16 * epsilon * h.norm()) << describe(pair);
  });
}

TEST(OverlapDerivativesTest, RigidMotionOfBothBodiesOnlyRotatesTheGradient) {
  for_each_contact(5, [](const Pair& pair) {
    Matrix12d h = hessian(pair);
    const Vector12d g = claim(pair).gradient;
    h.block<3, 3>(3, 3) -= skew(g.segment<3>(3)) / 2;
    h.block<3, 3>(9, 9) -= skew(g.segment<3>(9)) / 2;
    for (int c = 0; c < 3; ++c) {
      const Vector3d axis = Vector3d::Unit(c);
      Vector12d shift = Vector12d::Zero(), turn = Vector12d::Zero(), turned;
      shift.segment<3>(0) = shift.segment<3>(6) = axis;
      turn.segment<3>(3) = turn.segment<3>(9) = axis;
      turn.segment<3>(6) = axis.cross(pair.displacement());  // about A's centre
      for (int k = 0; k < 12; k += 3) turned.segment<3>(k) = axis.cross(g.segment<3>(k));
      // For nearly parallel faces some entries of H are much larger than their sum.
      const double limit = 1e-9 * (h.norm() + g.norm());
      EXPECT_LE((h * shift).norm(), limit) << describe(pair);
      EXPECT_LE((h * turn - turned).norm(), limit) << describe(pair);
    }
  });
}

}  // namespace
}  // namespace isojam
