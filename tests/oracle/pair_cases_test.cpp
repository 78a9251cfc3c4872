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

constexpr std::array contact_classes{PairClass::random_contact, PairClass::near_parallel_faces, PairClass::edge_in_face,
                                     PairClass::parallel_edges, PairClass::vertex_vertex};

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

/// Largest distance of a rotated vertex of B from the nearest vertex of A; 0 if the rotation is a symmetry.
double asymmetry(const PairCase& pair) {
  const Matrix3d turn = rotation(pair);
  double greatest = 0;
  for (const Vector3d& v : platonic(pair.b).vertices()) {
    double nearest = std::numeric_limits<double>::infinity();
    for (const Vector3d& w : platonic(pair.a).vertices()) nearest = std::min(nearest, (turn * v - w).norm());
    greatest = std::max(greatest, nearest);
  }
  return greatest;
}

/// Smallest distance of the displacement from a plane through the origin that is parallel to a face.
double out_of_plane(const PairCase& pair) {
  double least = std::numeric_limits<double>::infinity();
  for (const Face& f : platonic(pair.a).faces()) least = std::min(least, std::abs(f.normal.dot(pair.displacement)));
  return least;
}

TEST(PairCases, DependOnlyOnTheArguments) {
  for (const SolidKind kind : all_solids) {
    for (const PairClass pair_class : all_pair_classes) {
      const auto first = pair_cases(kind, kind, pair_class, 6), again = pair_cases(kind, kind, pair_class, 5);
      for (std::size_t k = 0; k < again.size(); ++k) {
        EXPECT_EQ(describe(first[k]), describe(again[k]));
        if (pair_class != PairClass::coincident) {
          EXPECT_NE(describe(first[k]), describe(first[k + 1])) << to_string(pair_class);
        }
      }
    }
  }
}

TEST(PairCases, ContactsSpreadOverTheirRangeOfVolumes) {
  for (const SolidKind kind : all_solids) {
    for (const PairClass pair_class : contact_classes) {
      double least = 1, greatest = 0;
      for (const PairCase& pair : pair_cases(kind, kind, pair_class, cases)) {
        const double volume = static_cast<double>(exact_overlap(pair).volume);
        least = std::min(least, volume);
        greatest = std::max(greatest, volume);
      }
      EXPECT_GE(least, least_contact_volume) << to_string(kind) << ", " << to_string(pair_class);
      EXPECT_LE(greatest, greatest_contact_volume) << to_string(kind) << ", " << to_string(pair_class);
      EXPECT_GE(greatest / least, 100) << to_string(kind) << ", " << to_string(pair_class);
    }
  }
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

TEST(PairCases, DegeneratePairsHaveTheGeometryOfTheirClass) {
  for (const SolidKind kind : all_solids) {
    const double size = platonic(kind).circumradius();
    for (const PairCase& pair : pair_cases(kind, kind, PairClass::same_orientation, cases)) {
      EXPECT_LE(asymmetry(pair), direction_error * size) << describe(pair);
      EXPECT_GT(pair.displacement.norm(), 0) << describe(pair);
    }
    for (const PairCase& pair : pair_cases(kind, kind, PairClass::coplanar_faces, cases)) {
      EXPECT_LE(asymmetry(pair), direction_error * size) << describe(pair);
      EXPECT_LE(out_of_plane(pair), direction_error * size) << describe(pair);
      EXPECT_GT(pair.displacement.norm(), 0) << describe(pair);
    }
    for (const PairCase& pair : pair_cases(kind, kind, PairClass::coincident, cases)) {
      EXPECT_LE(asymmetry(pair), direction_error * size) << describe(pair);
      EXPECT_EQ(pair.displacement.norm(), 0) << describe(pair);
    }
    for (const PairCase& pair : pair_cases(kind, kind, PairClass::near_coincident, cases)) {
      EXPECT_LE(asymmetry(pair), (1e-8 + direction_error) * size) << describe(pair);
      EXPECT_LE(pair.displacement.norm(), 1e-8) << describe(pair);
    }
  }
}

}  // namespace
}  // namespace isojam::oracle
