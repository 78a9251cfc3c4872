#include "engine/geometry/convex_solid.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <stdexcept>

namespace isojam {
namespace {

class Platonic : public testing::TestWithParam<SolidKind> {};

INSTANTIATE_TEST_SUITE_P(Solids, Platonic, testing::ValuesIn(all_solids),
                         [](const auto& solid) { return std::string(to_string(solid.param)); });

TEST_P(Platonic, HasUnitVolumeAndCentroidZero) {
  const ConvexSolid& solid = platonic(GetParam());
  double volume = 0;
  Eigen::Vector3d first = Eigen::Vector3d::Zero();
  for (const Face& face : solid.faces()) {
    const Eigen::Vector3d& a = solid.vertices()[face.vertices[0]];
    for (std::size_t k = 1; k + 1 < face.vertices.size(); ++k) {
      const Eigen::Vector3d& b = solid.vertices()[face.vertices[k]];
      const Eigen::Vector3d& c = solid.vertices()[face.vertices[k + 1]];
      volume += a.dot(b.cross(c)) / 6;
      first += a.dot(b.cross(c)) / 24 * (a + b + c);
    }
  }
  EXPECT_NEAR(volume, 1, 1e-14);
  EXPECT_LT(first.norm(), 1e-15 * solid.circumradius() * 10);
}

TEST_P(Platonic, ObeysEulersFormula) {
  const ConvexSolid& solid = platonic(GetParam());
  EXPECT_EQ(solid.vertices().size() + solid.faces().size(), solid.edges().size() + 2);
}

/// True if `to` follows `from` in the order of the face's vertices.
bool runs_along(const Face& face, int from, int to) {
  const std::size_t n = face.vertices.size();
  for (std::size_t k = 0; k < n; ++k) {
    if (face.vertices[k] == from && face.vertices[(k + 1) % n] == to) return true;
  }
  return false;
}

TEST_P(Platonic, EdgesRunBetweenTheirFaces) {
  const ConvexSolid& solid = platonic(GetParam());
  for (const Edge& edge : solid.edges()) {
    const Eigen::Vector3d along = solid.vertices()[edge.head] - solid.vertices()[edge.tail];
    const Eigen::Vector3d left = solid.faces()[edge.left].normal, right = solid.faces()[edge.right].normal;
    // The outward normal rotates about the edge from left to right.
    EXPECT_GT(left.cross(right).dot(along), 0) << edge.tail << " → " << edge.head;
    EXPECT_TRUE(runs_along(solid.faces()[edge.left], edge.tail, edge.head)) << edge.tail << " → " << edge.head;
    EXPECT_TRUE(runs_along(solid.faces()[edge.right], edge.head, edge.tail)) << edge.tail << " → " << edge.head;
    for (const int v : {edge.tail, edge.head}) {
      EXPECT_NEAR(left.dot(solid.vertices()[v]), solid.faces()[edge.left].offset, 1e-15);
      EXPECT_NEAR(right.dot(solid.vertices()[v]), solid.faces()[edge.right].offset, 1e-15);
    }
  }
}

TEST_P(Platonic, FacesHaveTheSameDistance) {
  const ConvexSolid& solid = platonic(GetParam());
  for (const Face& face : solid.faces()) {
    EXPECT_NEAR(face.offset, solid.inradius(), 1e-15);
    EXPECT_NEAR(face.normal.norm(), 1, 1e-15);
  }
}

TEST(ConvexSolidTest, RadiiMatchClosedForms) {
  const double edge = std::cbrt(6 * std::sqrt(2.0));  // tetrahedron of unit volume
  EXPECT_NEAR(platonic(SolidKind::tetrahedron).diameter(), edge, 1e-15 * edge * 2);
  EXPECT_NEAR(platonic(SolidKind::tetrahedron).circumradius(), edge * std::sqrt(6.0) / 4, 1e-15 * 2);
  EXPECT_NEAR(platonic(SolidKind::tetrahedron).gyration_radius(), edge / std::sqrt(20.0), 1e-15);
  EXPECT_NEAR(platonic(SolidKind::cube).gyration_radius(), std::sqrt(1.0 / 6), 1e-15);
  EXPECT_NEAR(platonic(SolidKind::octahedron).inradius(), std::cbrt(3 / std::sqrt(2.0)) / std::sqrt(6.0), 1e-15);
}

TEST(ConvexSolidTest, RejectsInvalidVertices) {
  using Points = std::vector<Eigen::Vector3d>;
  const Points with_inner{{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}, {0.1, 0.1, 0.1}};
  EXPECT_THROW(ConvexSolid("inner", with_inner), std::invalid_argument);
  const Points flat{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}};
  EXPECT_THROW(ConvexSolid("flat", flat), std::invalid_argument);
  const Points few{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  EXPECT_THROW(ConvexSolid("few", few), std::invalid_argument);
}

TEST(ConvexSolidTest, NamesAreReadAsWritten) {
  for (const SolidKind kind : all_solids) EXPECT_EQ(from_string<SolidKind>(to_string(kind)), kind);
  EXPECT_FALSE(from_string<SolidKind>("sphere"));
}

}  // namespace
}  // namespace isojam
