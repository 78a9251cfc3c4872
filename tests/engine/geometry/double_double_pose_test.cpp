// Reference: quadruple precision.

#include <gtest/gtest.h>

#include <cmath>

#include "engine/geometry/placed_solid.hpp"
#include "tests/engine/geometry/overlap/pairs.hpp"

namespace isojam {
namespace {

using namespace testing_pairs;
using Eigen::Vector3d;

/// About eight times the rounding error (1.2e-32) of a double-double near 1.
constexpr double tolerance = 1e-31;
constexpr int cases = 200;

double size(Quad x) { return std::abs(static_cast<double>(x)); }
double size(const Quad3& p) { return static_cast<double>(norm(p)); }
double size(const QuadMatrix& m) { return size(m[0]) + size(m[1]) + size(m[2]); }

Quad squared_length(const Pose& pose) {
  Quad sum = 0;
  for (int c = 0; c < 4; ++c) sum += widened(pose.component(c)) * widened(pose.component(c));
  return sum;
}

void expect_normal_form(const Pose& pose) {
  for (int c = 0; c < 3; ++c) EXPECT_EQ(pose.position[c], pose.position[c] + pose.position_low[c]);
  for (int c = 0; c < 4; ++c)
    EXPECT_EQ(pose.orientation.coeffs()[c], pose.orientation.coeffs()[c] + pose.orientation_low[c]);
  EXPECT_LE(size(squared_length(pose) - 1), 2 * tolerance);
}

Pose random_pose(RandomStream& random) {
  Pose pose;
  pose.position = 3 * random_direction(random);
  pose.orientation = random_orientation(random);
  return moved(pose, 1e-17 * random_direction(random), 1e-17 * random_direction(random));
}

/// The series of the rotation matrix exp([θ]×) to second order, where [θ]× v = θ×v.
QuadMatrix small_rotation(const Vector3d& theta) {
  const Quad x = theta.x(), y = theta.y(), z = theta.z();
  const QuadMatrix skew{Quad3{0, -z, y}, Quad3{z, 0, -x}, Quad3{-y, x, 0}};
  QuadMatrix result = skew * skew;
  for (int r = 0; r < 3; ++r) {
    result[r] = Quad(0.5) * result[r] + skew[r];
    result[r][r] += 1;
  }
  return result;
}

TEST(DoubleDoublePoseTest, SmallStepsAreNotLost) {
  RandomStream random{62, 1};
  for (int k = 0; k < cases; ++k) {
    const Pose pose = random_pose(random);
    for (const double h : {1e-10, 1e-18, 1e-25}) {
      const Vector3d dx = h * random_direction(random), theta = h * random_direction(random);
      const Pose there = moved(pose, dx, theta);
      expect_normal_form(there);
      const Quad3 shift = quad_position(there) - quad_position(pose);
      EXPECT_LE(size(shift - Quad3{dx.x(), dx.y(), dx.z()}), tolerance) << h;
      const QuadMatrix change = quad_rotation(there) - quad_rotation(pose);
      const QuadMatrix expected = small_rotation(theta) * quad_rotation(pose) - quad_rotation(pose);
      // The rotation has rounding errors in its last bits, and the series is exact only to third order.
      EXPECT_LE(size(change - expected), 16 * tolerance + 16 * epsilon * h + h * h * h) << h;
    }
  }
}

TEST(DoubleDoublePoseTest, LargeRotationsAgreeWithDoublePrecision) {
  RandomStream random{62, 3};
  for (int k = 0; k < cases; ++k) {
    const Pose pose = random_pose(random);
    const Vector3d theta = 10 * random.uniform() * random_direction(random);
    const Pose there = moved(pose, Vector3d::Zero(), theta);
    expect_normal_form(there);
    const Eigen::Quaterniond turn(Eigen::AngleAxisd(theta.norm(), theta.normalized()));
    const Eigen::Vector4d expected = (turn * pose.orientation).coeffs();
    EXPECT_LE((there.orientation.coeffs() - expected).norm(), 16 * epsilon) << theta.transpose();
    // A quaternion of another length represents the same rotation.
    Pose other_length = pose;
    other_length.orientation.coeffs() *= 8;
    other_length.orientation_low *= 8;
    EXPECT_LE(size(quad_rotation(other_length) - quad_rotation(pose)), tolerance);
    expect_normal_form(moved(other_length, Vector3d::Zero(), theta));
  }
}

TEST(DoubleDoublePoseTest, ScalingKeepsLowParts) {
  RandomStream random{62, 4};
  for (int k = 0; k < cases; ++k) {
    const Pose pose = random_pose(random);
    const DoubleDouble stretch = DoubleDouble(1 + random.uniform()) / 3.0;
    const Pose there = scaled(pose, stretch);
    expect_normal_form(there);
    EXPECT_LE(size(quad_position(there) - widened(stretch) * quad_position(pose)), 4 * tolerance);
    EXPECT_EQ(there.orientation.coeffs(), pose.orientation.coeffs());
    EXPECT_EQ(there.orientation_low, pose.orientation_low);
  }
}

TEST(DoubleDoublePoseTest, DeformationsMoveTheCentre) {
  RandomStream random{62, 8};
  for (int k = 0; k < cases; ++k) {
    const Pose pose = random_pose(random);
    DoubleDoubleMatrix f;
    for (int r = 0; r < 3; ++r) {
      for (int c = 0; c < 3; ++c) f.set(r, c, DoubleDouble(random.uniform() + (r == c)) / 3.0);
    }
    const Pose there = deformed(pose, f);
    expect_normal_form(there);
    EXPECT_LE(size(quad_position(there) - widened(f) * quad_position(pose)), 16 * tolerance);
    EXPECT_EQ(there.orientation.coeffs(), pose.orientation.coeffs());
    EXPECT_EQ(there.orientation_low, pose.orientation_low);
  }
}

TEST(DoubleDoublePoseTest, RelativePoseIsInTheFrameOfA) {
  RandomStream random{62, 5};
  for (int k = 0; k < cases; ++k) {
    const Pose a = random_pose(random), b = random_pose(random);
    const Quad3 r = quad_position(b) - quad_position(a);
    const QuadPose relative = relative_pose(a, b, r);
    EXPECT_LE(size(quad_rotation(a) * relative.rotation - quad_rotation(b)), tolerance);
    EXPECT_LE(size(quad_rotation(a) * relative.displacement - r), 4 * tolerance);
    const RelativePose in_double = relative_pose(a.orientation, b.orientation, rounded(r)), close = narrowed(relative);
    EXPECT_LE((close.rotation - in_double.rotation).norm(), 16 * epsilon);
    EXPECT_LE((close.displacement - in_double.displacement).norm(), 64 * epsilon);
    const QuadPose exact = widened(in_double);
    EXPECT_EQ(narrowed(exact).rotation, in_double.rotation);
    EXPECT_EQ(narrowed(exact).displacement, in_double.displacement);
  }
}

class SolidConstants : public testing::TestWithParam<SolidKind> {};

INSTANTIATE_TEST_SUITE_P(Solids, SolidConstants, testing::ValuesIn(all_solids),
                         [](const auto& solid) { return std::string(to_string(solid.param)); });

TEST_P(SolidConstants, AreAccurate) {
  const ConvexSolid& solid = platonic(GetParam());
  const SolidArrays& flat = solid.arrays();
  Quad volume = 0;
  Quad3 sum{};
  for (int v = 0; v < flat.vertices; ++v) {
    EXPECT_EQ(rounded(flat.vertex(v)), solid.vertices()[v]);
    sum = sum + flat.vertex(v);
  }
  for (int f = 0; f < flat.faces; ++f) {
    const Face& face = solid.faces()[f];
    EXPECT_EQ(rounded(flat.normal(f)), face.normal);
    EXPECT_LE(size(dot(flat.normal(f), flat.normal(f)) - 1), tolerance) << "face " << f;
    for (const int v : face.vertices)
      EXPECT_LE(size(dot(flat.normal(f), flat.vertex(v)) - flat.plane_offset(f)), tolerance) << v << " on " << f;
    for (std::size_t k = 1; k + 1 < face.vertices.size(); ++k) {
      const Quad3 p = flat.vertex(face.vertices[0]), q = flat.vertex(face.vertices[k]),
                  s = flat.vertex(face.vertices[k + 1]);
      volume += dot(p, cross(q, s)) / 6;
    }
  }
  EXPECT_LE(size(volume - 1), 4 * tolerance);
  EXPECT_LE(size(sum), 4 * tolerance);
}

}  // namespace
}  // namespace isojam
