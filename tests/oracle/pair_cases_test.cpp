// Tests the pairs that the accuracy tests use.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "tasks/extras/chart/pairs/pair_cases.hpp"
#include "tests/oracle/exact_overlap.hpp"
#include "tests/oracle/overlap_checks.hpp"

namespace isojam::oracle {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

/// Allowed error of the directions of unit vectors, which is a few ulp.
constexpr double direction_error = 32 * std::numeric_limits<double>::epsilon();

constexpr int cases = 20;

Matrix3d rotation(const PairCase& pair) { return rotation_matrix(pair.pose()).high; }

Vector3d edge_direction(const ConvexSolid& solid, const Edge& edge) {
  return (solid.vertices()[edge.head] - solid.vertices()[edge.tail]).normalized();
}

/// Smallest angle between a face of A and a face of B that face each other.
double face_tilt(const PairCase& pair) {
  const Matrix3d turn = rotation(pair);
  double least = 1;
  for (const Face& a : platonic(pair.a).faces()) {
    for (const Face& b : platonic(pair.b).faces()) least = std::min(least, (a.normal + turn * b.normal).norm());
  }
  return least;
}

/// Smallest sine of the angle between an edge of A and a face of B.
double edge_tilt(const PairCase& pair) {
  const Matrix3d turn = rotation(pair);
  double least = 1;
  for (const Edge& e : platonic(pair.a).edges()) {
    const Vector3d along = edge_direction(platonic(pair.a), e);
    for (const Face& b : platonic(pair.b).faces()) least = std::min(least, std::abs(along.dot(turn * b.normal)));
  }
  return least;
}

/// Smallest sine of the angle between an edge of A and an edge of B.
double edge_angle(const PairCase& pair) {
  const Matrix3d turn = rotation(pair);
  double least = 1;
  for (const Edge& e : platonic(pair.a).edges()) {
    for (const Edge& f : platonic(pair.b).edges()) {
      const Vector3d b = turn * edge_direction(platonic(pair.b), f);
      least = std::min(least, edge_direction(platonic(pair.a), e).cross(b).norm());
    }
  }
  return least;
}

/// Smallest sine of the angle between the displacement and a vertex of A, or between the reversed displacement and a
/// vertex of B, whichever is larger.
double vertex_angle(const PairCase& pair) {
  const auto least = [](const ConvexSolid& solid, const Vector3d& direction) {
    double sine = 1;
    for (const Vector3d& v : solid.vertices()) {
      if (v.dot(direction) > 0) sine = std::min(sine, v.normalized().cross(direction.normalized()).norm());
    }
    return sine;
  };
  const Vector3d from_b = -(rotation(pair).transpose() * pair.displacement);
  return std::max(least(platonic(pair.a), pair.displacement), least(platonic(pair.b), from_b));
}

TEST(PairCases, ContactsHaveTheGeometryOfTheirClass) {
  for (const SolidKind kind : all_solids) {
    double least_tilt = 1, greatest_tilt = 0;
    for (const PairCase& pair : pair_cases(kind, kind, PairClass::near_parallel_faces, cases)) {
      least_tilt = std::min(least_tilt, face_tilt(pair));
      greatest_tilt = std::max(greatest_tilt, face_tilt(pair));
    }
    EXPECT_GE(least_tilt, 1e-10 - direction_error) << to_string(kind);
    EXPECT_LE(greatest_tilt, 1e-2 + direction_error) << to_string(kind);
    EXPECT_GE(greatest_tilt / least_tilt, 1e4) << to_string(kind);
    for (const PairCase& pair : pair_cases(kind, kind, PairClass::edge_in_face, cases)) {
      EXPECT_LE(edge_tilt(pair), 1e-2 + direction_error) << describe(pair);
    }
    for (const PairCase& pair : pair_cases(kind, kind, PairClass::parallel_edges, cases)) {
      EXPECT_LE(edge_angle(pair), direction_error) << describe(pair);
    }
    for (const PairCase& pair : pair_cases(kind, kind, PairClass::vertex_vertex, cases)) {
      EXPECT_LE(vertex_angle(pair), direction_error) << describe(pair);
    }
    for (const PairCase& pair : pair_cases(kind, kind, PairClass::random_contact, cases)) {
      EXPECT_GT(std::abs(pair.quaternion.norm() - 1), direction_error) << describe(pair);
      EXPECT_GT(face_tilt(pair), direction_error) << describe(pair);
    }
  }
}

}  // namespace
}  // namespace isojam::oracle
