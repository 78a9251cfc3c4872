#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <cstdio>
#include <limits>

#include "engine/geometry/planar_faces.hpp"
#include "engine/geometry/repair.hpp"
#include "engine/geometry/solids/named_solids.hpp"
#include "engine/geometry/solids/solid.hpp"
#include "engine/random/stream.hpp"

namespace isojam {
namespace {

using Eigen::Vector3d;
using Points = std::vector<Vector3d>;

constexpr double eps = std::numeric_limits<double>::epsilon();

const std::vector<std::string>& names() {
  static const std::vector<std::string> list{"tetrahedron",
                                             "cube",
                                             "octahedron",
                                             "dodecahedron",
                                             "icosahedron",
                                             "truncated_tetrahedron",
                                             "cuboctahedron",
                                             "truncated_cube",
                                             "rhombic_dodecahedron",
                                             "truncated_octahedron",
                                             "prism3",
                                             "prism7",
                                             "prism21",
                                             "antiprism5",
                                             "antiprism16"};
  return list;
}

Eigen::Quaterniond random_rotation(RandomStream& random) {
  return Eigen::Quaterniond(random.normal(), random.normal(), random.normal(), random.normal()).normalized();
}

/// Vertices of a built-in solid after a rotation in quadruple precision, rounded once.
Points rounded_vertices(const std::string& name, const Eigen::Quaterniond& q, double size, const Vector3d& origin) {
  const Eigen::Matrix3d turn = q.toRotationMatrix();
  Points points;
  const std::vector<Quad3> vertices = *named_vertices(name);
  for (const Quad3& v : vertices) {
    Vector3d point;
    for (int c = 0; c < 3; ++c) {
      const Quad x = Quad(turn(c, 0)) * v[0] + Quad(turn(c, 1)) * v[1] + Quad(turn(c, 2)) * v[2];
      point[c] = static_cast<double>(size * (x + origin[c]));
    }
    points.push_back(point);
  }
  return points;
}

/// Largest distance of a corner from its face in quadruple precision, in units of the circumradius.
double largest_mismatch(const ConvexSolid& solid) {
  Quad largest = 0;
  for (std::size_t f = 0; f < solid.faces().size(); ++f) {
    for (const int v : solid.faces()[f].vertices) {
      const auto face = static_cast<int>(f);
      const Quad height =
          dot(solid.arrays().normal(face), solid.arrays().vertex(v)) - solid.arrays().plane_offset(face);
      largest = std::max(largest, height < 0 ? -height : height);
    }
  }
  return static_cast<double>(largest) / solid.circumradius();
}

/// Requires that planes, vertices and heights agree, and that all other vertices are below each plane.
void expect_consistent(const ConvexSolid& solid, const std::string& what) {
  const SolidArrays& arrays = solid.arrays();
  // The entries are pairs of doubles, with errors of 1e-32.
  EXPECT_LE(largest_mismatch(solid), 1e-30) << what;
  for (int f = 0; f < arrays.faces; ++f) {
    const FaceLoop& corners = solid.faces()[static_cast<std::size_t>(f)].vertices;
    for (int v = 0; v < arrays.vertices; ++v) {
      if (std::find(corners.begin(), corners.end(), v) != corners.end()) {
        EXPECT_EQ(arrays.heights_above(f)[v], 0) << what;
        continue;
      }
      const Quad height = dot(arrays.normal(f), arrays.vertex(v)) - arrays.plane_offset(f);
      EXPECT_LT(arrays.heights_above(f)[v], 0) << what;
      EXPECT_NEAR(static_cast<double>(height - Quad(arrays.heights_above(f)[v])), 0,
                  eps * -arrays.heights_above(f)[v] + 1e-30)
          << what;
    }
  }
}

void expect_same_bits(const ConvexSolid& solid, const ConvexSolid& other, const std::string& what) {
  for (int v = 0; v < solid.arrays().vertices; ++v) {
    const Quad3 p = solid.arrays().vertex(v), q = other.arrays().vertex(v);
    EXPECT_TRUE(p == q) << what << ", vertex " << v;
  }
  for (int f = 0; f < solid.arrays().faces; ++f) {
    EXPECT_TRUE(solid.arrays().normal(f) == other.arrays().normal(f)) << what << ", face " << f;
    EXPECT_TRUE(solid.arrays().plane_offset(f) == other.arrays().plane_offset(f)) << what << ", face " << f;
  }
}

TEST(GivenVertices, MakeExactlyPlanarFacesForAnySizeAndOrigin) {
  RandomStream random{91};
  double moved = 0, mismatch = 0;
  int solids = 0;
  for (const std::string& name : names()) {
    const Solid exact = *Solid::named(name);
    for (const double size : {1e-9, 1.0, 1e9}) {
      for (const double distance : {0.0, 1.0, 1e4, 1e8}) {
        const Vector3d origin = distance * Vector3d(random.normal(), random.normal(), random.normal()).normalized();
        const auto what = name + " of size " + std::to_string(size) + " at " + std::to_string(distance);
        const Points points = rounded_vertices(name, random_rotation(random), size, origin);
        const ConvexSolid solid("rounded", points);
        EXPECT_EQ(solid.faces().size(), exact->faces().size()) << what;
        EXPECT_EQ(solid.edges().size(), exact->edges().size()) << what;
        expect_consistent(solid, what);
        expect_same_bits(solid, ConvexSolid("again", solid.given()), what);
        EXPECT_NEAR(solid.inradius(), exact->inradius(), 64 * eps * (2 + distance)) << what;
        mismatch = std::max(mismatch, largest_mismatch(solid));
        moved = std::max(moved, shape_of(solid).largest_distance / (eps * (1 + distance)));
        ++solids;
      }
    }
  }
  std::printf("%d solids: mismatch %.1e, corners up to %.1f ulp of the largest coordinate from their faces\n", solids,
              mismatch, moved);
  EXPECT_EQ(solids, 180);
}

/// The move that makes faces planar, relative to the tolerance, over solids with many faces.
TEST(GivenVertices, MoveByLessThanTheTolerance) {
  RandomStream random{92};
  double worst = 0;
  for (const std::string& name : names()) {
    for (int k = 0; k < 10; ++k) {
      const Points points = rounded_vertices(name, random_rotation(random), 1, Vector3d::Zero());
      std::vector<Quad3> exact;
      for (const Vector3d& p : points) exact.push_back({p.x(), p.y(), p.z()});
      const PlanarSolid planar = with_planar_faces(exact, hull_faces(exact), 1);
      worst = std::max(worst, static_cast<double>(planar.largest_move / rounding_tolerance(exact)));
    }
  }
  std::printf("largest move: %.2f of the tolerance\n", worst);
  EXPECT_LT(worst, 1);
}

TEST(GivenVertices, OfBuiltInSolidsKeepEachBit) {
  double worst = 0;
  for (const std::string& name : names()) {
    const std::vector<Quad3> vertices = *named_vertices(name);
    const PlanarSolid planar = with_planar_faces(vertices, hull_faces(vertices), 0);
    EXPECT_TRUE(planar.vertices == vertices) << name;
    EXPECT_EQ(static_cast<double>(planar.largest_move), 0) << name;
    worst = std::max(worst, static_cast<double>(planar.largest_distance));
  }
  std::printf("built-in solids: corners up to %.1e from their planes\n", worst);
  EXPECT_LE(worst, 1e-31);
}

/// x written with this number of digits.
double written(double x, int digits) {
  char text[64];
  std::snprintf(text, sizeof text, "%.*e", digits - 1, x);
  return std::strtod(text, nullptr);
}

TEST(GivenVertices, WrittenWithFewDigitsAreJoined) {
  RandomStream random{93};
  double worst = 0;
  for (const std::string& name : names()) {
    const Solid exact = *Solid::named(name);
    for (const int digits : {6, 9, 12, 15}) {
      const auto what = name + " with " + std::to_string(digits) + " digits";
      Points points = rounded_vertices(name, random_rotation(random), 1, Vector3d::Zero());
      for (Vector3d& p : points) p = p.unaryExpr([&](double x) { return written(x, digits); });
      const RepairedSolid repair = repaired(points, {.merge = 20 * std::pow(10, -digits)});
      const ConvexSolid solid("joined", repair.vertices);
      EXPECT_EQ(solid.faces().size(), exact->faces().size()) << what;
      EXPECT_EQ(solid.edges().size(), exact->edges().size()) << what;
      EXPECT_EQ(repair.report.welded + repair.report.dropped + repair.report.removed_corners, 0) << what;
      EXPECT_LT(std::abs(repair.report.volume_change), 20 * std::pow(10, -digits)) << what;
      expect_consistent(solid, what);
      expect_same_bits(solid, ConvexSolid("again", solid.given()), what);
      worst = std::max(worst, repair.report.largest_move * std::pow(10, digits));
    }
  }
  std::printf("joined faces: corners move by up to %.1f units of the last digit\n", worst);
  EXPECT_LT(worst, 20);
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
