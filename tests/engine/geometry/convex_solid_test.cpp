#include "engine/geometry/convex_solid.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

namespace isojam {
namespace {

class Platonic : public testing::TestWithParam<SolidKind> {};

INSTANTIATE_TEST_SUITE_P(Solids, Platonic, testing::ValuesIn(all_solids),
                         [](const auto& solid) { return std::string(to_string(solid.param)); });

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

TEST(ConvexSolidTest, RadiiMatchClosedForms) {
  const double edge = std::cbrt(6 * std::sqrt(2.0));  // tetrahedron of unit volume
  EXPECT_NEAR(platonic(SolidKind::tetrahedron).diameter(), edge, 1e-15 * edge * 2);
  EXPECT_NEAR(platonic(SolidKind::tetrahedron).circumradius(), edge * std::sqrt(6.0) / 4, 1e-15 * 2);
  EXPECT_NEAR(platonic(SolidKind::tetrahedron).gyration_radius(), edge / std::sqrt(20.0), 1e-15);
  EXPECT_NEAR(platonic(SolidKind::cube).gyration_radius(), std::sqrt(1.0 / 6), 1e-15);
  EXPECT_NEAR(platonic(SolidKind::octahedron).inradius(), std::cbrt(3 / std::sqrt(2.0)) / std::sqrt(6.0), 1e-15);
}

}  // namespace
}  // namespace isojam
