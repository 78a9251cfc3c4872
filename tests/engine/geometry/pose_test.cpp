#include "engine/geometry/pose.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "tests/engine/geometry/overlap/pairs.hpp"

namespace isojam {
namespace {

using namespace testing_pairs;
using Eigen::Quaterniond;
using Eigen::Vector3d;

constexpr int cases = 200;
/// The error of entries of a product of a few rotations is a few ulp of 1.
constexpr double rotation_error = 16 * epsilon;

Vector3d placed(const RelativePose& pose, const Vector3d& y) { return pose.rotation * y + pose.displacement; }

TEST(RelativePoseTest, AgreesWithTheLabFrame) {
  RandomStream random{1, 11};
  for (int k = 0; k < cases; ++k) {
    const Pair pair = random_pair(random, SolidKind::cube, SolidKind::cube, 3 * random.uniform());
    const Vector3d y = random_direction(random);
    const Vector3d in_lab = pair.b.orientation * y + pair.b.position;
    const Vector3d in_a = pair.a.orientation.conjugate() * (in_lab - pair.a.position);
    EXPECT_LE((placed(pair.relative(), y) - in_a).norm(), rotation_error * pair.reach()) << describe(pair);
  }
}

TEST(RelativePoseTest, ExchangeInverts) {
  RandomStream random{1, 12};
  for (int k = 0; k < cases; ++k) {
    const Pair pair = random_pair(random, SolidKind::cube, SolidKind::cube, 3 * random.uniform());
    const Vector3d y = random_direction(random);
    const Vector3d there_and_back = placed(exchanged(pair).relative(), placed(pair.relative(), y));
    EXPECT_LE((there_and_back - y).norm(), rotation_error * pair.reach()) << describe(pair);
  }
}

TEST(RelativePoseTest, DoesNotChangeIfBothBodiesRotate) {
  RandomStream random{1, 13};
  for (int k = 0; k < cases; ++k) {
    const Pair pair = random_pair(random, SolidKind::cube, SolidKind::cube, 3 * random.uniform());
    const Quaterniond turn = random_orientation(random);
    const RelativePose before = pair.relative();
    const RelativePose after =
        relative_pose(turn * pair.a.orientation, turn * pair.b.orientation, turn * pair.displacement());
    EXPECT_LE((after.rotation - before.rotation).cwiseAbs().maxCoeff(), rotation_error) << describe(pair);
    EXPECT_LE((after.displacement - before.displacement).norm(), rotation_error * pair.reach()) << describe(pair);
  }
}

TEST(RotatedTest, IsRodriguesFormulaInTheLabFrame) {
  RandomStream random{1, 14};
  for (int k = 0; k < cases; ++k) {
    const Quaterniond q = random_orientation(random);
    const Vector3d axis = random_direction(random), y = random_direction(random);
    // Angles from far below an ulp to more than a full rotation.
    const double angle = 10 * std::pow(10.0, -20 * random.uniform());
    const Vector3d x = q * y;
    const Vector3d turned =
        std::cos(angle) * x + std::sin(angle) * axis.cross(x) + (1 - std::cos(angle)) * axis.dot(x) * axis;
    const Quaterniond result = rotated(q, angle * axis);
    EXPECT_LE((result * y - turned).norm(), rotation_error * (1 + angle)) << "angle " << angle;
    EXPECT_NEAR(result.norm(), 1, 2 * epsilon) << "angle " << angle;
  }
}

TEST(RotatedTest, RotationsAboutOneAxisAdd) {
  RandomStream random{1, 15};
  for (int k = 0; k < cases; ++k) {
    const Quaterniond q = random_orientation(random);
    const Vector3d theta = std::numbers::pi * random_direction(random);
    const double s = random.uniform(), t = random.uniform();
    const Quaterniond twice = rotated(rotated(q, s * theta), t * theta), once = rotated(q, (s + t) * theta);
    EXPECT_LE((twice.coeffs() - once.coeffs()).norm(), rotation_error) << "s " << s << ", t " << t;
  }
}

TEST(RotatedTest, ZeroAndSmallestRotationsAreRegular) {
  RandomStream random{1, 16};
  const Quaterniond q = random_orientation(random);
  for (const double angle : {0.0, std::numeric_limits<double>::denorm_min(), std::numeric_limits<double>::min()}) {
    const Quaterniond same = rotated(q, angle * Vector3d::UnitX());
    EXPECT_LE((same.coeffs() - q.coeffs()).norm(), 2 * epsilon) << "angle " << angle;
  }
}

}  // namespace
}  // namespace isojam
