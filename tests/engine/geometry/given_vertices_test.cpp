#include <gtest/gtest.h>

#include <cstdio>

#include "engine/geometry/planar_faces.hpp"
#include "engine/geometry/solids/named_solids.hpp"

namespace isojam {
namespace {

TEST(GivenVertices, OfBuiltInSolidsKeepEachBit) {
  double worst = 0;
  for (const std::string_view name : named_solids()) {
    const std::vector<Quad3> vertices = *named_vertices(name);
    const PlanarSolid planar = with_planar_faces(vertices, hull_faces(vertices), 0);
    EXPECT_TRUE(planar.vertices == vertices) << name;
    EXPECT_EQ(static_cast<double>(planar.largest_move), 0) << name;
    worst = std::max(worst, static_cast<double>(planar.largest_distance));
  }
  std::printf("built-in solids: corners up to %.1e from their planes\n", worst);
  EXPECT_LE(worst, 1e-31);
}

/// A cube whose top corner is raised: its three faces there are not planar.
std::vector<Quad3> raised_cube(double by) {
  std::vector<Quad3> cube;
  for (int k = 0; k < 8; ++k) cube.push_back({k & 1 ? 1.0 : -1.0, k & 2 ? 1.0 : -1.0, k & 4 ? 1.0 : -1.0});
  for (Quad& c : cube.back()) c += by;
  return cube;
}

TEST(PlanarFaces, RefuseMovesThatAreTooLongAndSolidsThatAreNotConvex) {
  const std::vector<FaceLoop> faces = hull_faces(raised_cube(0));
  const PlanarSolid planar = with_planar_faces(raised_cube(1e-3), faces, 1e-2);
  EXPECT_LE(static_cast<double>(planar.largest_move), 2e-3);
  EXPECT_GT(static_cast<double>(planar.largest_move), 1e-5);
  EXPECT_THROW(with_planar_faces(raised_cube(1e-3), faces, 1e-5), NoSolid);
  std::vector<Quad3> dented = *named_vertices("octahedron");
  const std::vector<FaceLoop> triangles = hull_faces(dented);
  for (Quad& c : dented[0]) c = -c / 2;
  EXPECT_THROW(with_planar_faces(dented, triangles, 10), NoSolid);
}

}  // namespace
}  // namespace isojam
