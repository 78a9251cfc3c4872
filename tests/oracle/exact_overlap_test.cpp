// Tests the exact reference itself, without the overlaps of the engine.

#include "tests/oracle/exact_overlap.hpp"

#include <gtest/gtest.h>

#include <cstdio>

#include "engine/random/stream.hpp"
#include "tests/oracle/overlap_checks.hpp"

namespace isojam::oracle {
namespace {

/// Error of the planes of the solids, relative to their size.
constexpr double plane_error = 1e-31;

Pose at(const Eigen::Vector3d& position, const Eigen::Quaterniond& q = Eigen::Quaterniond::Identity()) {
  Pose pose;
  pose.position = position, pose.orientation = q;
  return pose;
}

ExactOverlap of(SolidKind kind, const Pose& at_b) {
  return exact_overlap<Rational>({platonic(kind), {}}, {platonic(kind), at_b});
}

double relative(const Real& found, const Real& right) {
  return static_cast<double>(Real(abs(Real(found - right)) / abs(right)));
}

double relative(const RealVector& found, const RealVector& right) {
  return static_cast<double>(Real((found - right).norm() / right.norm()));
}

TEST(ExactOverlap, CornersOfCubesHaveTheirClosedForm) {
  RandomStream random{1};
  for (int trial = 0; trial < 20; ++trial) {
    const Eigen::Vector3d shift(random.uniform(), 1 - random.uniform() / 1e9, random.uniform());
    const ExactOverlap overlap = of(SolidKind::cube, at(shift));
    const Real half = .5, x = shift[0] / 2, y = shift[1] / 2, z = shift[2] / 2;  // centre of the overlap
    const Real a = 1 - Real(shift[0]), b = 1 - Real(shift[1]), c = 1 - Real(shift[2]);
    const RealVector area(b * c, c * a, a * b);
    const RealVector moment = RealVector(half, y, z).cross(RealVector(area[0], 0, 0)) +
                              RealVector(x, half, z).cross(RealVector(0, area[1], 0)) +
                              RealVector(x, y, half).cross(RealVector(0, 0, area[2]));
    EXPECT_LT(relative(overlap.volume, a * b * c), 1e-40) << shift.transpose();
    EXPECT_LT(relative(overlap.area, area), 1e-40) << shift.transpose();
    EXPECT_LT(relative(overlap.moment, moment), 1e-40) << shift.transpose();
  }
}

TEST(ExactOverlap, VertexInAFaceOfATetrahedronHasItsClosedForm) {
  const Real edge = pow(6 * sqrt(Real(2)), Real(1) / 3), height = edge * sqrt(Real(2) / 3);
  for (const double depth : {1e-12, 1e-6, .01, .3}) {
    // B above a vertex of A: the overlap is a tetrahedron
    const auto step = static_cast<double>(Real((height - depth) / sqrt(Real(3))));
    const ExactOverlap overlap = of(SolidKind::tetrahedron, at({step, step, step}));
    const Real deep = height - step * sqrt(Real(3)), expected = pow(deep / height, 3);
    EXPECT_LT(relative(overlap.volume, expected), 10 * plane_error / depth) << depth;
    const Real slope = sqrt(Real(3)) * expected / deep;  // dV/d(depth) along each axis
    EXPECT_LT(relative(overlap.area, RealVector(slope, slope, slope)), 10 * plane_error / depth) << depth;
  }
}

TEST(ExactOverlap, RationalAndFloatingNumbersAgree) {
  for (const PairClass pair_class : all_pair_classes) {
    if (is_contested(pair_class)) continue;
    double volume = 0, area = 0;
    for (const SolidKind kind : all_solids) {
      for (const PairCase& pair : pair_cases(kind, kind, pair_class, 2)) {
        const Placed a{platonic(kind), {}}, b{platonic(kind), pair.pose()};
        const ExactOverlap exact = exact_overlap<Rational>(a, b), real = exact_overlap<Real>(a, b);
        volume = std::max(volume, relative(real.volume, exact.volume));
        area = std::max(area, relative(real.area, exact.area));
      }
    }
    std::printf("%-20s V differs by %.1e, S by %.1e\n", std::string(to_string(pair_class)).c_str(), volume, area);
    EXPECT_LT(volume, 1e-22) << to_string(pair_class);
    EXPECT_LT(area, 1e-20) << to_string(pair_class);
  }
}

}  // namespace
}  // namespace isojam::oracle
