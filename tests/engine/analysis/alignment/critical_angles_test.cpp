#include "engine/analysis/alignment/critical_angles.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <numbers>
#include <vector>

#include "engine/geometry/solids/solid.hpp"
#include "engine/random/stream.hpp"

namespace isojam {
namespace {

using Eigen::Vector3d;
using std::numbers::pi;

constexpr double rounding = 16 * std::numeric_limits<double>::epsilon();

std::array<double, 5> as_array(const CriticalAngles& c) {
  return {c.ef_vertex_face, c.ef_edge_edge, c.ff_vertex_face, c.ff_edge_edge, c.ff_edge_face};
}

struct Schlafli {
  double p, q;
};

Schlafli schlafli(const ConvexSolid& solid) {
  return {static_cast<double>(solid.faces().front().vertices.size()),
          2 * static_cast<double>(solid.edges().size()) / static_cast<double>(solid.vertices().size())};
}

TEST(CriticalAngles, AgreeWithClosedFormsOfTheSchlafliSymbol) {
  for (const SolidKind kind : all_solids) {
    const auto [p, q] = schlafli(platonic(kind));
    const double sine = std::cos(pi / q) / std::sin(pi / p);  // sine of δ/2, where δ is the dihedral angle
    const double cosine = std::sqrt(1 - sine * sine);
    const CriticalAngles c = critical_angles(platonic(kind));
    EXPECT_NEAR(std::cos(c.ef_vertex_face), std::cos(pi / p) / std::sin(pi / q), rounding) << to_string(kind);
    EXPECT_NEAR(std::sin(c.ff_vertex_face), cosine / std::sin(pi / q), rounding) << to_string(kind);
    EXPECT_NEAR(std::sin(c.ef_edge_edge), cosine, rounding) << to_string(kind);
    EXPECT_NEAR(std::cos(c.ff_edge_edge), sine * sine, rounding) << to_string(kind);
    EXPECT_NEAR(std::sin(c.ff_edge_face), cosine, rounding) << to_string(kind);
  }
}

TEST(CriticalAngles, AgreeWithConesOfNormals) {
  for (const SolidKind kind : all_solids) {
    const auto closed = as_array(critical_angles(platonic(kind))),
               of_cones = as_array(critical_angles_of_cones(platonic(kind)));
    for (std::size_t k = 0; k < closed.size(); ++k)
      EXPECT_NEAR(of_cones[k], closed[k], rounding) << to_string(kind) << ' ' << k;
  }
}

TEST(CriticalAngles, AreTheSmallestOverUnlikeVertices) {
  std::vector<Vector3d> box, pyramid{{0, 0, 1}};
  for (int k = 0; k < 8; ++k) box.emplace_back(k & 1 ? 1 : -1, k & 2 ? 2 : -2, k & 4 ? 3 : -3);
  for (int k = 0; k < 4; ++k) pyramid.emplace_back(k & 1 ? 1 : -1, k & 2 ? 1 : -1, 0);
  // The normal cones and edges of any box are those of a cube.
  const auto cube = as_array(critical_angles(platonic(SolidKind::cube)));
  const auto of_box = as_array(critical_angles(ConvexSolid("box", box)));
  for (std::size_t k = 0; k < cube.size(); ++k) EXPECT_NEAR(of_box[k], cube[k], rounding) << k;
  // At the apex, four faces have an angle of 45° to the base and 120° between neighbours. Their normals are at 45° from
  // the axis, and the edges rise by 35.26°. At the corners of the base three faces meet, and a search finds smaller
  // angles there.
  const CriticalAngles of_pyramid = critical_angles(ConvexSolid("pyramid", pyramid));
  EXPECT_NEAR(of_pyramid.ff_edge_face, pi / 6, rounding) << "of the widest dihedral angle, 120°";
  EXPECT_LE(of_pyramid.ff_vertex_face, pi / 4 + rounding);
  EXPECT_LE(of_pyramid.ef_vertex_face, std::asin(1 / std::sqrt(3.0)) + rounding);
}

TEST(CriticalAngles, OfAFlatVertexAreThoseOfItsTwoLowestEdges) {
  // The four edges of the flat vertex rise by 0.1 over lengths of 1 and 2. The inscribed circle of its normal cone
  // touches only two sides, which are opposite to each other.
  const std::vector<Vector3d> vertices{{1, 0, 0}, {-1, 0, 0}, {0, 2, 0}, {0, -2, 0}, {0, 0, .1}, {0, 0, -.1}};
  const ConvexSolid flat("flat", vertices);
  EXPECT_NEAR(critical_angles(flat).ef_vertex_face, std::atan(.1 / 2), 20 * rounding);
}

/// A lower bound of the critical angles by brute force: the largest angle over directions in the cone of each vertex,
/// and the smallest of these over the vertices.
CriticalAngles searched(const ConvexSolid& solid, RandomStream& random) {
  std::vector<double> ef(solid.vertices().size(), 0), ff(solid.vertices().size(), 0);
  std::vector<std::vector<Vector3d>> normals(ff.size()), along(ff.size());
  for (const Face& face : solid.faces()) {
    for (const int v : face.vertices) normals[v].push_back(face.normal);
  }
  for (const Edge& edge : solid.edges()) {
    const Vector3d direction = (solid.vertices()[edge.head] - solid.vertices()[edge.tail]).normalized();
    along[edge.head].push_back(direction), along[edge.tail].push_back(direction);
  }
  for (int k = 0; k < 100000; ++k) {
    const Vector3d d = Vector3d(random.normal(), random.normal(), random.normal()).normalized();
    std::size_t outermost = 0;
    for (std::size_t v = 1; v < solid.vertices().size(); ++v) {
      if (solid.vertices()[v].dot(d) > solid.vertices()[outermost].dot(d)) outermost = v;
    }
    double cosine = -1, sine = 1;
    for (const Vector3d& normal : normals[outermost]) cosine = std::max(cosine, normal.dot(d));
    for (const Vector3d& direction : along[outermost]) sine = std::min(sine, std::abs(direction.dot(d)));
    ff[outermost] = std::max(ff[outermost], std::acos(std::min(1.0, cosine)));
    ef[outermost] = std::max(ef[outermost], std::asin(sine));
  }
  CriticalAngles least;
  least.ef_vertex_face = *std::min_element(ef.begin(), ef.end());
  least.ff_vertex_face = *std::min_element(ff.begin(), ff.end());
  return least;
}

TEST(CriticalAngles, OfOtherSolidsAgreeWithASearch) {
  RandomStream random{63};
  std::vector<Vector3d> rock;
  for (int k = 0; k < 9; ++k) rock.push_back(Vector3d(random.normal(), random.normal(), random.normal()).normalized());
  // Three faces meet at the origin. Their normals form a triangle that does not contain its circumcentre. The angles
  // between the edges are 110°, 110° and 30°.
  const double half = pi / 12, down = std::cos(11 * pi / 18) / std::cos(half);
  const std::vector<Vector3d> leaning{{0, 0, 0},
                                      {std::cos(half), std::sin(half), 0},
                                      {std::cos(half), -std::sin(half), 0},
                                      {down, 0, std::sqrt(1 - down * down)}};
  const std::vector<Solid> solids{*Solid::named("truncated_tetrahedron"),
                                  *Solid::named("cuboctahedron"),
                                  *Solid::named("rhombic_dodecahedron"),
                                  *Solid::named("prism6"),
                                  *Solid::named("antiprism5"),
                                  Solid::made_of("rock", rock),
                                  Solid::made_of("leaning", leaning)};
  for (const Solid& solid : solids) {
    const CriticalAngles exact = critical_angles(*solid), found = searched(*solid, random);
    EXPECT_LE(found.ff_vertex_face, exact.ff_vertex_face + rounding) << to_string(solid);
    EXPECT_LE(found.ef_vertex_face, exact.ef_vertex_face + rounding) << to_string(solid);
    EXPECT_NEAR(found.ff_vertex_face, exact.ff_vertex_face, .03) << to_string(solid);
    EXPECT_NEAR(found.ef_vertex_face, exact.ef_vertex_face, .03) << to_string(solid);
  }
}

TEST(CriticalAngles, OfFacesNearlyInOnePlaneKeepHalfOfTheirDigits) {
  double worst = 0;
  for (double height = 1e-2; height > 5e-10; height /= 10) {
    std::vector<Vector3d> bent, roof;
    for (int k = 0; k < 8; ++k) bent.emplace_back(k & 1 ? 1 : -1, k & 2 ? 1 : -1, k & 4 ? 1 : -1);
    roof = bent;
    // Its upper face is two triangles with slopes of h/2 in the directions x and y. The cosine of the angle between
    // their normals is thus 1/(1 + h²/4).
    bent.back().z() += height;
    // Its upper face is a pyramid with four slopes.
    roof.emplace_back(0, 0, 1 + height);
    const double alpha = std::atan(height / std::sqrt(2.0) * std::sqrt(1 + height * height / 8)) / 2,
                 p = std::pow(std::sin(alpha / 2), 2);
    const CriticalAngles edge = critical_angles(ConvexSolid("bent", bent));
    const double crossed = 2 * std::asin(std::sqrt(2 * p * (1 - p))), slope = std::atan(height);
    const CriticalAngles apex = critical_angles(ConvexSolid("roof", roof));
    const CriticalAngles both = critical_angles(ConvexSolid("bent", bent), ConvexSolid("bent", bent));
    const double limit = 1e-12 + 1e-13 / height;
    EXPECT_NEAR(edge.ff_edge_face / alpha, 1, limit) << height;
    // The arccos of a product of cosines is used as long as it has half of its digits.
    EXPECT_NEAR(edge.ff_edge_edge / crossed, 1, limit + 1e-8) << height;
    EXPECT_NEAR(both.ff_edge_edge / crossed, 1, limit + 1e-8) << height;
    EXPECT_NEAR(apex.ff_vertex_face / slope, 1, limit) << height;
    worst = std::max(worst, std::abs(edge.ff_edge_edge / crossed - 1) * height);
  }
  std::printf("crossed edges: errors up to %.1e of a face angle\n", worst);
}

}  // namespace
}  // namespace isojam
