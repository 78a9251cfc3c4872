// Properties tested here, with quadruple precision as reference:
// - moved() and scaled() keep the low parts: steps of 1e-25 are not lost, a thousand steps add up to their sum, and the
//   high part is the nearest double.
// - moved() rotates by exp(θ) and keeps |q| = 1 to 1e-31. A quaternion q other than 0 represents the same rotation as
//   q/|q|.
// - rotation_matrix() and the vertices and normals of placed solids have errors of at most 1e-31.
// - relative_pose() with low parts gives the rotation of B relative to A, and agrees with the version in double.
// - A solid's constants are correct to 1e-31: planes through their vertices, unit normals, unit volume, centroid 0.

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "engine/geometry/placed_solid.hpp"
#include "tests/engine/geometry/overlap/pairs.hpp"

namespace isojam {
namespace {

using namespace testing_pairs;
using Eigen::Vector3d;

/// A few times the last bit of a double-double number near 1.
constexpr double last_bits = 1e-31;
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
  EXPECT_LE(size(squared_length(pose) - 1), 2 * last_bits);
}

Pose random_pose(RandomStream& random) {
  Pose pose;
  pose.position = 3 * random_direction(random);
  pose.orientation = random_orientation(random);
  return moved(pose, 1e-17 * random_direction(random), 1e-17 * random_direction(random));
}

/// 1 + [θ]× + ½[θ]×² for a small rotation.
QuadMatrix small_turn(const Vector3d& theta) {
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
      EXPECT_LE(size(shift - Quad3{dx.x(), dx.y(), dx.z()}), last_bits) << h;
      const QuadMatrix turned = quad_rotation(there) - quad_rotation(pose);
      const QuadMatrix expected = small_turn(theta) * quad_rotation(pose) - quad_rotation(pose);
      // The rotation has rounding errors in its last bits, and the series is exact only to third order.
      EXPECT_LE(size(turned - expected), 16 * last_bits + 16 * epsilon * h + h * h * h) << h;
    }
  }
}

TEST(DoubleDoublePoseTest, ManySmallStepsAddUp) {
  RandomStream random{62, 2};
  const Pose start = random_pose(random);
  Pose pose = start;
  Quad3 sum{};
  Vector3d angle = Vector3d::Zero();
  const Vector3d axis = random_direction(random);
  const int steps = 1000;
  for (int k = 0; k < steps; ++k) {
    const Vector3d dx = 1e-20 * random_direction(random);
    const double turn = 1e-20 * random.uniform();
    pose = moved(pose, dx, turn * axis);
    sum = sum + Quad3{dx.x(), dx.y(), dx.z()};
    angle += turn * axis;
  }
  expect_normal_form(pose);
  EXPECT_LE(size(quad_position(pose) - quad_position(start) - sum), steps * last_bits);
  EXPECT_LE(size(quad_rotation(pose) - small_turn(angle) * quad_rotation(start)), steps * last_bits);
}

TEST(DoubleDoublePoseTest, LargeRotationsAgreeWithDoubles) {
  RandomStream random{62, 3};
  for (int k = 0; k < cases; ++k) {
    const Pose pose = random_pose(random);
    const Vector3d theta = 10 * random.uniform() * random_direction(random);
    const Pose there = moved(pose, Vector3d::Zero(), theta);
    expect_normal_form(there);
    const Eigen::Vector4d expected = rotated(pose.orientation, theta).coeffs();
    EXPECT_LE((there.orientation.coeffs() - expected).norm(), 16 * epsilon) << theta.transpose();
    // The same rotation, by a quaternion with another norm.
    Pose longer = pose;
    longer.orientation.coeffs() *= 8;
    longer.orientation_low *= 8;
    EXPECT_LE(size(quad_rotation(longer) - quad_rotation(pose)), last_bits);
    expect_normal_form(moved(longer, Vector3d::Zero(), theta));
  }
}

TEST(DoubleDoublePoseTest, ScalingKeepsLowParts) {
  RandomStream random{62, 4};
  for (int k = 0; k < cases; ++k) {
    const Pose pose = random_pose(random);
    const DoubleDouble stretch = DoubleDouble(1 + random.uniform()) / 3.0;
    const Pose there = scaled(pose, stretch);
    expect_normal_form(there);
    EXPECT_LE(size(quad_position(there) - widened(stretch) * quad_position(pose)), 4 * last_bits);
    EXPECT_EQ(there.orientation.coeffs(), pose.orientation.coeffs());
    EXPECT_EQ(there.orientation_low, pose.orientation_low);
  }
}

TEST(DoubleDoublePoseTest, RotationMatricesAreAccurate) {
  RandomStream random{62, 6};
  for (int k = 0; k < cases; ++k) {
    Pose pose = random_pose(random);
    EXPECT_LE(size(widened(rotation_matrix(pose)) - quad_rotation(pose)), 4 * last_bits);
    pose.orientation_low.setZero();
    EXPECT_LE(size(widened(rotation_matrix(pose)) - quad_rotation(pose)), 4 * last_bits) << "rounded";
    for (const double length : {1e-6, 1 + 1e-9, 3.0, 1e6}) {
      Pose longer = pose;
      longer.orientation.coeffs() *= length;
      EXPECT_LE(size(widened(rotation_matrix(longer)) - quad_rotation(longer)), 4 * last_bits) << length;
    }
  }
}

TEST(DoubleDoublePoseTest, NaNStaysNaN) {
  Pose pose;
  pose.orientation.x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(rotation_matrix(pose).high.hasNaN());
  EXPECT_TRUE(moved(pose, Vector3d::Zero(), Vector3d::Zero()).orientation.coeffs().hasNaN());
  pose.orientation.coeffs().setZero();
  EXPECT_FALSE(rotation_matrix(pose).high.allFinite());
}

TEST(DoubleDoublePoseTest, RelativePoseIsTheRotationRelativeToA) {
  RandomStream random{62, 5};
  for (int k = 0; k < cases; ++k) {
    const Pose a = random_pose(random), b = random_pose(random);
    const Quad3 r = quad_position(b) - quad_position(a);
    const QuadPose relative = relative_pose(a, b, r);
    EXPECT_LE(size(quad_rotation(a) * relative.rotation - quad_rotation(b)), last_bits);
    EXPECT_LE(size(quad_rotation(a) * relative.displacement - r), 4 * last_bits);
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

TEST_P(SolidConstants, AreCorrectToTheirLowParts) {
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
    EXPECT_LE(size(dot(flat.normal(f), flat.normal(f)) - 1), last_bits) << "face " << f;
    for (const int v : face.vertices)
      EXPECT_LE(size(dot(flat.normal(f), flat.vertex(v)) - flat.plane_offset(f)), last_bits) << v << " on " << f;
    for (std::size_t k = 1; k + 1 < face.vertices.size(); ++k) {
      const Quad3 p = flat.vertex(face.vertices[0]), q = flat.vertex(face.vertices[k]),
                  s = flat.vertex(face.vertices[k + 1]);
      volume += dot(p, cross(q, s)) / 6;
    }
  }
  EXPECT_LE(size(volume - 1), 4 * last_bits);
  EXPECT_LE(size(sum), 4 * last_bits);
}

TEST_P(SolidConstants, ArePlacedInDoubleDoubles) {
  RandomStream random{62, 7};
  const ConvexSolid& solid = platonic(GetParam());
  for (int k = 0; k < cases / 10; ++k) {
    const Pose pose = random_pose(random);
    const LonePlacedSolid alone(solid, rotation_matrix(pose));
    const PlacedSolid placed = alone.view();
    const QuadMatrix turn = quad_rotation(pose);
    EXPECT_LE(size(widened(placed.rotation_double_double()) - turn), 4 * last_bits);
    for (int v = 0; v < placed.vertices(); ++v) {
      EXPECT_LE(size(widened(placed.vertex_double_double(v)) - turn * solid.arrays().vertex(v)), 4 * last_bits) << v;
      EXPECT_EQ(placed.vertex(v), placed.vertex_double_double(v).high);
    }
    for (int f = 0; f < placed.faces(); ++f) {
      EXPECT_LE(size(widened(placed.normal_double_double(f)) - turn * solid.arrays().normal(f)), 4 * last_bits) << f;
      EXPECT_TRUE(widened(placed.offset_double_double(f)) == solid.arrays().plane_offset(f));
    }
  }
}

}  // namespace
}  // namespace isojam
