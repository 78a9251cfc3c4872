// Reference: clipping in quadruple precision. Prints a table of errors against depth.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <vector>

#include "engine/geometry/overlap/clipped_overlap.hpp"
#include "tests/engine/geometry/overlap/pairs.hpp"

namespace isojam {
namespace {

using namespace testing_pairs;
using Eigen::Vector3d;

constexpr double limit = 1e-14;
constexpr int cases = 20;

QuadOverlap in_lab(const ConvexSolid& a, const ConvexSolid& b, const Pose& pose_a, const Pose& pose_b) {
  const Quad3 r = quad_position(pose_b) - quad_position(pose_a);
  QuadOverlap result = clipped_overlap(a, b, relative_pose(pose_a, pose_b, r));
  result.area = quad_rotation(pose_a) * result.area;
  result.moment = quad_rotation(pose_a) * result.moment;
  return result;
}

QuadOverlap exact(const Pair& pair) { return in_lab(pair.solid_a(), pair.solid_b(), pair.a, pair.b); }

DoubleDoubleVector narrowed(const Quad3& p) {
  DoubleDoubleVector result;
  for (int c = 0; c < 3; ++c) result.set(c, isojam::narrowed(p[c]));
  return result;
}

DoubleDoubleVector displacement_double_double(const Pair& pair) {
  return narrowed(quad_position(pair.b) - quad_position(pair.a));
}

LonePlacedSolid placed(const ConvexSolid& solid, const Pose& pose) { return {solid, rotation_matrix(pose)}; }

Overlap in_double_double(const Pair& pair, const ConvexSolid& a, const ConvexSolid& b) {
  SeparatingAxis axis;
  return overlap(placed(a, pair.a), placed(b, pair.b), displacement_double_double(pair), axis);
}

Overlap in_double_double(const Pair& pair) { return in_double_double(pair, pair.solid_a(), pair.solid_b()); }

/// The same state, rounded to doubles.
Overlap in_double(const Pair& pair) {
  SeparatingAxis axis;
  return overlap(placed(pair.solid_a(), pair.a), placed(pair.solid_b(), pair.b), pair.displacement(), axis);
}

/// Largest relative error of V, S and M. The error of M is relative to the larger of |M| and h |S|, where h is the
/// inradius.
double error(const Overlap& measured, const QuadOverlap& exact, double inradius) {
  const auto part = [](const Vector3d& value, const Quad3& right, Quad scale) {
    return static_cast<double>(norm(Quad3{value.x(), value.y(), value.z()} - right) / scale);
  };
  const Quad lever = norm(exact.moment), area = norm(exact.area);
  return std::max({std::abs(static_cast<double>((measured.volume - exact.volume) / exact.volume)),
                   part(measured.area, exact.area, area),
                   part(measured.moment, exact.moment, lever > area * inradius ? lever : area * inradius)});
}

double error(const Overlap& measured, const QuadOverlap& exact, const Pair& pair) {
  return error(measured, exact, pair.solid_a().inradius());
}

/// A face of B on a face of A, rotated at random about the normal, shifted along the face, and tilted by up to `depth`.
/// The deepest vertex of B is `depth` behind A's plane.
Pair face_contact(RandomStream& random, SolidKind kind, double depth) {
  const ConvexSolid& solid = platonic(kind);
  Pair pair{kind, kind, {}, {}};
  pair.a.position = random_direction(random);
  pair.a.orientation = random_orientation(random);
  const std::vector<Face>& faces = solid.faces();
  const Face &face_a = faces[random.bits() % faces.size()], &face_b = faces[random.bits() % faces.size()];
  const Vector3d n = pair.a.orientation * face_a.normal;
  const Eigen::Quaterniond twist(Eigen::AngleAxisd(6 * random.uniform(), n));
  pair.b.orientation = twist * Eigen::Quaterniond::FromTwoVectors(face_b.normal, -n);
  const Vector3d along = .3 * solid.inradius() * n.cross(random_direction(random));
  pair.b.position = pair.a.position + 2 * solid.inradius() * n + along;
  pair.b = moved(pair.b, Vector3d::Zero(), depth * random.uniform() * n.cross(random_direction(random)));

  const QuadMatrix turn_a = quad_rotation(pair.a), turn_b = quad_rotation(pair.b);
  const auto f = static_cast<int>(&face_a - faces.data());
  const Quad3 normal = turn_a * solid.arrays().normal(f), r = quad_position(pair.b) - quad_position(pair.a);
  Quad lowest = 1;
  for (int v = 0; v < solid.arrays().vertices; ++v)
    lowest = std::min(lowest, dot(normal, turn_b * solid.arrays().vertex(v) + r) - solid.arrays().plane_offset(f));
  const auto correction = static_cast<double>(lowest + depth);
  pair.b = moved(pair.b, -correction * n, Vector3d::Zero());
  return pair;
}

class DoubleDoubleOverlap : public testing::TestWithParam<SolidKind> {};

INSTANTIATE_TEST_SUITE_P(Solids, DoubleDoubleOverlap, testing::ValuesIn(all_solids),
                         [](const auto& solid) { return std::string(to_string(solid.param)); });

TEST_P(DoubleDoubleOverlap, IsAccurateAtEveryDepth) {
  RandomStream random{64, static_cast<std::uint64_t>(GetParam())};
  for (double depth = 1e-4; depth > .5e-13; depth /= 10) {
    double worst = 0, plain = 0;
    for (int k = 0; k < cases; ++k) {
      const Pair pair = face_contact(random, GetParam(), depth);
      const QuadOverlap right = exact(pair);
      const Overlap measured = in_double_double(pair);
      worst = std::max(worst, error(measured, right, pair));
      EXPECT_EQ(measured.path, OverlapPath::loop) << depth << ": " << describe(pair);
      EXPECT_EQ(measured.faces_a, right.faces_a) << depth << ": " << describe(pair);
      EXPECT_EQ(measured.faces_b, right.faces_b) << depth << ": " << describe(pair);
      EXPECT_EQ(measured.edges_a, right.edges_a) << depth << ": " << describe(pair);
      EXPECT_EQ(measured.edges_b, right.edges_b) << depth << ": " << describe(pair);
      plain = std::max(plain, error(in_double(pair), right, pair));
    }
    EXPECT_LE(worst, limit) << "depth " << depth;
    if (depth < 2e-10) {
      EXPECT_GE(plain, 1e-8) << "depth " << depth;
    }
    std::printf("%-13s depth %.0e: largest error %.1e, in double %.1e\n", std::string(to_string(GetParam())).c_str(),
                depth, worst, plain);
  }
}

/// A contact in a random orientation, moved until V is between a third and three times `volume`.
Pair pointed_contact(RandomStream& random, SolidKind a, SolidKind b, double volume) {
  const Pair deep = random_contact(random, a, b, 1e-4, 1e-2);
  double near = 0, far = deep.displacement().norm();
  for (;;) {
    const double middle = (near + far) / 2;
    Pair pair = deep;
    pair.b = moved(deep.b, middle * deep.displacement().normalized(), Vector3d::Zero());
    const double found = in_double_double(pair).volume;
    if (volume / 3 < found && found < 3 * volume) return pair;
    (found > volume ? near : far) = middle;
  }
}

/// Derivatives of (S_A, M_A) with respect to (x, θ) of one body, by differences in quadruple precision.
Matrix6d differences(const Pair& pair, bool of_a, double h) {
  Matrix6d result;
  for (int k = 0; k < 6; ++k) {
    const Vector6d step = h * Vector6d::Unit(k);
    Pair ahead = pair, behind = pair;
    Pose &there = of_a ? ahead.a : ahead.b, &back = of_a ? behind.a : behind.b;
    there = moved(there, step.head<3>(), step.tail<3>());
    back = moved(back, -step.head<3>(), -step.tail<3>());
    const QuadOverlap p = exact(ahead), q = exact(behind);
    result.col(k).head<3>() = rounded((1 / (2 * Quad(h))) * (p.area - q.area));
    result.col(k).tail<3>() = rounded((1 / (2 * Quad(h))) * (p.moment - q.moment));
  }
  return result;
}

/// `h` is the step of the differences; it must be far below the depth of the contact.
void expect_hessians_are_differences(const Pair& pair, double h) {
  SeparatingAxis unused;
  OverlapHessian hessian;
  const DoubleDoubleVector r = displacement_double_double(pair);
  overlap_with_hessian(placed(pair.solid_a(), pair.a), placed(pair.solid_b(), pair.b), r, unused, hessian);
  // Rotations do not commute. Therefore, the derivative of M with respect to rotations of the same body has an
  // antisymmetric part that is not a second derivative of V.
  const Matrix6d by_b = differences(pair, false, h), by_a = differences(pair, true, h);
  EXPECT_LE((hessian.ab - by_b).norm(), 1e-9 * by_b.norm()) << "step " << h << ": " << describe(pair);
  EXPECT_LE((hessian.aa - (by_a + by_a.transpose()) / 2).norm(), 1e-9 * by_a.norm())
      << "step " << h << ": " << describe(pair);
}

TEST_P(DoubleDoubleOverlap, HessiansAreDifferencesInQuadruplePrecision) {
  RandomStream random{67, static_cast<std::uint64_t>(GetParam())};
  for (const double depth : {1e-2, 1e-4, 1e-6, 1e-8}) {
    for (int k = 0; k < 3; ++k) {
      const Pair pair = depth > 1e-3 ? random_contact(random, GetParam(), GetParam(), 1e-5, 3e-2)
                                     : face_contact(random, GetParam(), depth);
      expect_hessians_are_differences(pair, 1e-8 * depth);
    }
  }
}

TEST_P(DoubleDoubleOverlap, HessiansOfPointedContactsAreDifferencesToo) {
  RandomStream random{68, static_cast<std::uint64_t>(GetParam())};
  for (const double volume : {1e-6, 1e-9, 1e-12, 1e-15}) {
    for (const SolidKind other : all_solids)
      expect_hessians_are_differences(pointed_contact(random, GetParam(), other, volume), 1e-7 * std::cbrt(volume));
  }
}

TEST_P(DoubleDoubleOverlap, AgreesWithDoubleWhereItSuffices) {
  RandomStream random{68, static_cast<std::uint64_t>(GetParam())};
  for (int k = 0; k < 5 * cases; ++k) {
    const Pair pair = random_contact(random, GetParam(), GetParam(), 1e-5, 3e-2);
    // Sums over a small contact have rounding errors of coordinates of order 1.
    EXPECT_LE(error(in_double_double(pair), exact(pair), pair), 1e-11) << describe(pair);
    EXPECT_LE(error(in_double(pair), exact(pair), pair), 1e-10) << describe(pair);
  }
}

TEST(DoubleDoubleOverlapTest, ResolvesDepthsBelowTheRoundingOfDoubles) {
  for (const double depth : {1e-17, 1e-20, 1e-25}) {
    Pair pair{SolidKind::cube, SolidKind::cube, {}, {}};
    pair.b.position = Vector3d(.25, .125, 1);
    pair.b = moved(pair.b, Vector3d(0, 0, -depth), Vector3d::Zero());
    const Overlap touching = in_double_double(pair);
    // The loop cannot distinguish the ends of such a short edge, so the slow path computes the result. The coordinates
    // of the state have the rounding error ε² of double-double.
    EXPECT_NEAR(touching.volume, .75 * .875 * depth, 4 * epsilon * (depth + epsilon));
    EXPECT_NEAR(touching.area.z(), .75 * .875, 4 * epsilon);
    pair.b = moved(pair.b, Vector3d(0, 0, 2 * depth), Vector3d::Zero());
    EXPECT_FALSE(in_double_double(pair).touching());
  }
}

TEST_P(DoubleDoubleOverlap, CoincidentSolidsUseTheSlowPath) {
  RandomStream random{69, static_cast<std::uint64_t>(GetParam())};
  Pair pair{GetParam(), GetParam(), {}, {}};
  pair.a.orientation = random_orientation(random);
  pair.a = pair.b = moved(pair.a, Vector3d::Zero(), 1e-17 * random_direction(random));
  const Overlap result = in_double_double(pair);
  EXPECT_EQ(result.path, OverlapPath::clip);
  EXPECT_NEAR(result.volume, 1, 4 * epsilon);
}

}  // namespace
}  // namespace isojam
