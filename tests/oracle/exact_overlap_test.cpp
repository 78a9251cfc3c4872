// Tests the exact reference itself, without the engine.

#include <gtest/gtest.h>

#include "engine/random/stream.hpp"
#include "tasks/extras/chart/pairs/pair_cases.hpp"
#include "tests/oracle/exact_overlap.hpp"
#include "tests/oracle/overlap_checks.hpp"

namespace isojam::oracle {
namespace {

ExactPose pose_of(const RealQuaternion& q, const Real& x, const Real& y, const Real& z) { return {q, {x, y, z}}; }

ExactPose shifted(const Real& x, const Real& y, const Real& z) { return {ExactPose{}.quaternion, {x, y, z}}; }

double relative(const Real& found, const Real& right) {
  return static_cast<double>(Real(abs(found - right) / abs(right)));
}

double relative(const RealVector& found, const RealVector& right) {
  return static_cast<double>(Real((found - right).norm() / right.norm()));
}

/// The pose of B relative to A after A was rotated by q about its own centre.
ExactPose a_turned(const ExactPose& pose, const RealQuaternion& q) {
  const ExactPose frame = inverse({q, RealVector(-pose.displacement)});
  return {RealQuaternion(frame.quaternion * pose.quaternion), frame.displacement};
}

TEST(ExactOverlap, CoincidentSolidsHaveUnitVolume) {
  for (const SolidKind kind : all_solids) {
    for (const RealQuaternion& q :
         {RealQuaternion(1, 0, 0, 0), RealQuaternion(0, 0, 3, 0), RealQuaternion(1, -1, 1, 1)}) {
      const ExactOverlap overlap = exact_overlap(kind, kind, {q, RealVector::Zero()});
      EXPECT_LT(relative(overlap.volume, 1), 1e-55) << to_string(kind);
      EXPECT_FALSE(overlap.single_valued);
      EXPECT_EQ(overlap.faces_a, (1ULL << platonic(kind).faces().size()) - 1) << to_string(kind);
    }
  }
}

TEST(ExactOverlap, CornersOfCubesHaveTheirClosedForm) {
  RandomStream random{1};
  for (int trial = 0; trial < 20; ++trial) {
    const Real a = random.uniform() + 1e-12, b = random.uniform() / 1e9 + 1e-12, c = random.uniform() + 1e-12;
    const ExactOverlap overlap = exact_overlap(SolidKind::cube, SolidKind::cube, shifted(1 - a, 1 - b, 1 - c));
    const RealVector area(b * c, c * a, a * b);
    const Real x = (1 - a) / 2, y = (1 - b) / 2, z = (1 - c) / 2, half = .5;
    const RealVector moment = RealVector(half, y, z).cross(RealVector(area[0], 0, 0)) +
                              RealVector(x, half, z).cross(RealVector(0, area[1], 0)) +
                              RealVector(x, y, half).cross(RealVector(0, 0, area[2]));
    EXPECT_LT(relative(overlap.volume, a * b * c), 1e-50) << a << ' ' << b << ' ' << c;
    EXPECT_LT(relative(overlap.area, area), 1e-50) << a << ' ' << b << ' ' << c;
    EXPECT_LT(relative(overlap.moment, moment), 1e-50) << a << ' ' << b << ' ' << c;
    EXPECT_TRUE(overlap.single_valued);
  }
}

TEST(ExactOverlap, VertexInAFaceOfATetrahedronHasItsClosedForm) {
  const Real edge = cbrt(6 * sqrt(Real(2)));
  const Real height = edge * sqrt(Real(2) / 3);  // B above a vertex of A: the overlap is a tetrahedron
  for (const double depth : {1e-12, 1e-6, .01, .3}) {
    const Real step = (height - depth) / sqrt(Real(3));
    const ExactOverlap overlap =
        exact_overlap(SolidKind::tetrahedron, SolidKind::tetrahedron, shifted(step, step, step));
    const Real expected = pow(depth / height, 3);
    EXPECT_LT(relative(overlap.volume, expected), 1e-45) << depth;
    const Real slope = sqrt(Real(3)) * expected / depth;  // dV/d(depth) along each axis
    EXPECT_LT(relative(overlap.area, RealVector(slope, slope, slope)), 1e-45) << depth;
  }
}

TEST(ExactOverlap, WedgeInAFaceGrowsAsTheSquareOfTheDepth) {
  const RealQuaternion q(2, 0, 0, 1);  // rotates about z by the angle with cosine 3/5 and sine 4/5
  for (const double depth : {1e-15, 1e-7, .01}) {
    const ExactPose pose = pose_of(q, Real(1) / 2 + Real(7) / 10 - depth, 0, 0);
    const ExactOverlap overlap = exact_overlap(SolidKind::cube, SolidKind::cube, pose);
    const Real expected = Real(25) / 24 * depth * depth;
    EXPECT_LT(relative(overlap.volume, expected), 1e-40) << depth;
    // The tops and bottoms of the two cubes are coplanar. Their contributions to S cancel by symmetry, but each could
    // be counted for either cube.
    EXPECT_FALSE(overlap.single_valued);
    const ExactOverlap lifted =
        exact_overlap(SolidKind::cube, SolidKind::cube, {q, pose.displacement + RealVector(0, 0, .25)});
    EXPECT_LT(relative(lifted.volume, expected * 3 / 4), 1e-40) << depth;
    EXPECT_TRUE(lifted.single_valued);
  }
}

TEST(ExactOverlap, FirstContactInARandomOrientationIsOfThirdOrder) {
  for (const SolidKind kind : all_solids) {
    for (const PairCase& pair : pair_cases(kind, kind, PairClass::random_contact, 5)) {
      ExactPose pose = exact_pose(pair);
      const RealVector direction = pose.displacement.normalized();
      Real low = 0, high = 2;  // distance beyond the given contact: touching, free
      for (int halving = 0; halving < 60; ++halving) {
        const Real middle = (low + high) / 2;
        const bool touch =
            exact_overlap(kind, kind, {pose.quaternion, pose.displacement + middle * direction}).volume > 0;
        (touch ? low : high) = middle;
      }
      const auto root = [&](const Real& depth) {
        return cbrt(exact_overlap(kind, kind, {pose.quaternion, pose.displacement + (low - depth) * direction}).volume);
      };
      const Real step = 1e-9;
      // V^(1/3) is exactly linear in the depth while the touching features stay the same.
      const Real first = root(step), second = root(2 * step), third = root(3 * step);
      EXPECT_LT(relative(first + third, 2 * second), 1e-30) << describe(pair);
      EXPECT_GT(first, 0) << describe(pair);
    }
  }
}

TEST(ExactOverlap, HullAndSuccessiveCutsGiveOneVolume) {
  for (const SolidKind kind : all_solids) {
    for (const PairClass pair_class : all_pair_classes) {
      for (const PairCase& pair : pair_cases(kind, kind, pair_class, 3)) {
        const Real hull = exact_overlap(kind, kind, exact_pose(pair)).volume;
        ASSERT_GT(hull, 0) << describe(pair);
        EXPECT_LT(relative(exact_clipped_volume(kind, kind, exact_pose(pair)), hull), 1e-60) << describe(pair);
      }
    }
  }
}

TEST(ExactOverlap, ExchangingTheSolidsChangesSigns) {
  for (const SolidKind a : all_solids) {
    for (const SolidKind b : all_solids) {
      for (const PairCase& pair : pair_cases(a, b, PairClass::random_contact, 2)) {
        const ExactPose pose = exact_pose(pair);
        const ExactOverlap from_a = exact_overlap(a, b, pose), from_b = exact_overlap(b, a, inverse(pose));
        const RealMatrix rotation = pose.quaternion.normalized().toRotationMatrix();
        const RealVector moment = -from_a.moment + pose.displacement.cross(from_a.area);
        EXPECT_LT(relative(from_b.volume, from_a.volume), 1e-60) << describe(pair);
        EXPECT_LT(relative(RealVector(rotation * from_b.area), RealVector(-from_a.area)), 1e-50) << describe(pair);
        EXPECT_LT(relative(RealVector(rotation * from_b.moment), moment), 1e-50) << describe(pair);
        EXPECT_EQ(from_b.faces_a, from_a.faces_b);
        EXPECT_EQ(from_b.edges_a, from_a.edges_b);
      }
    }
  }
}

TEST(ExactOverlap, AreaAndMomentAreTheGradientOfTheVolume) {
  const Real h = 1e-12;  // truncation ~ h², far above the noise of 1e-55 / h
  for (const SolidKind kind : all_solids) {
    for (const PairCase& pair : pair_cases(kind, kind, PairClass::random_contact, 4)) {
      const ExactPose pose = exact_pose(pair);
      const auto volume = [&](const ExactPose& p) { return exact_overlap(kind, kind, p).volume; };
      RealVector area, moment;
      for (int k = 0; k < 3; ++k) {
        const RealVector axis = RealVector::Unit(k);
        const auto moved = [&](const Real& step) {
          return ExactPose{pose.quaternion, pose.displacement - step * axis};  // A moves by +step
        };
        const auto turned = [&](const Real& step) {
          const RealVector v = step / 2 * axis;  // tan(θ/2) = θ/2 to sufficient order
          return a_turned(pose, RealQuaternion(1, v[0], v[1], v[2]));
        };
        area[k] = (volume(moved(h)) - volume(moved(-h))) / (2 * h);
        moment[k] = (volume(turned(h)) - volume(turned(-h))) / (2 * h);
      }
      const ExactOverlap overlap = exact_overlap(kind, kind, pose);
      EXPECT_LT(relative(area, overlap.area), 1e-16) << describe(pair);
      EXPECT_LT(relative(moment, overlap.moment), 1e-16) << describe(pair);
    }
  }
}

TEST(ExactOverlap, SharedFacesHaveNoSingleGradient) {
  for (const SolidKind kind : all_solids) {
    for (const PairCase& pair : pair_cases(kind, kind, PairClass::random_contact, 5)) {
      const ExactOverlap overlap = exact_overlap(kind, kind, exact_pose(pair));
      EXPECT_TRUE(overlap.single_valued) << describe(pair);
      EXPECT_LT(overlap.contested_area, 1e-10) << describe(pair);
    }
    int shared = 0;
    const auto pairs = pair_cases(kind, kind, PairClass::coplanar_faces, 20);
    for (const PairCase& pair : pairs) shared += !exact_overlap(kind, kind, exact_pose(pair)).single_valued;
    EXPECT_GT(shared, 0) << to_string(kind);
  }
}

TEST(ExactOverlap, DisjointAndTouchingPairsHaveNoVolume) {
  struct Touch {
    Real x, y, z;
    bool single_valued;
  };
  for (const Touch& t : {Touch{2, 0, 0, true}, Touch{1 + Real(1e-60), 0, 0, true}, Touch{1, .5, .25, false},
                         Touch{1, 1, .25, true}, Touch{1, 1, 1, true}}) {
    const ExactOverlap overlap = exact_overlap(SolidKind::cube, SolidKind::cube, shifted(t.x, t.y, t.z));
    EXPECT_EQ(overlap.volume, 0) << t.x << ' ' << t.y << ' ' << t.z;
    EXPECT_EQ(overlap.single_valued, t.single_valued) << t.x << ' ' << t.y << ' ' << t.z;
  }
  EXPECT_GT(exact_overlap(SolidKind::cube, SolidKind::cube, shifted(1 - Real(1e-30), 0, 0)).volume, 0);
}

TEST(ExactOverlap, ZeroQuaternionIsRejected) {
  EXPECT_THROW(exact_overlap(SolidKind::cube, SolidKind::cube, pose_of(RealQuaternion(0, 0, 0, 0), 0, 0, 0)),
               std::invalid_argument);
}

}  // namespace
}  // namespace isojam::oracle
