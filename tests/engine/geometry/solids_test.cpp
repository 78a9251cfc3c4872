#include "engine/geometry/solids/solid.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <limits>
#include <numbers>

#include "engine/geometry/hull.hpp"
#include "engine/geometry/solids/named_solids.hpp"
#include "engine/random/stream.hpp"

namespace isojam {
namespace {

using Eigen::Vector3d;
using Points = std::vector<Vector3d>;
using std::numbers::pi;

constexpr double eps = std::numeric_limits<double>::epsilon();

/// A solid, its numbers of features, and its volume for edges of length 1.
struct Expected {
  std::string name;
  std::size_t vertices, edges, faces;
  double volume;
};

std::vector<Expected> expected_solids() {
  const double root2 = std::sqrt(2.0);
  std::vector<Expected> list{{"truncated_tetrahedron", 12, 18, 8, 23 * root2 / 12},
                             {"cuboctahedron", 12, 24, 14, 5 * root2 / 3},
                             {"rhombic_dodecahedron", 14, 24, 12, 16 * std::sqrt(3.0) / 9},
                             {"truncated_octahedron", 24, 36, 14, 8 * root2},
                             {"truncated_cube", 24, 36, 14, (21 + 14 * root2) / 3}};
  for (const std::size_t n : {3, 5, 6, 7, 8, 9, 10, 11, 15, 16, 20, 21, 22, 32, 43, 63, 64}) {
    const auto m = static_cast<double>(n);
    list.push_back({"prism" + std::to_string(n), 2 * n, 3 * n, n + 2, m / 4 / std::tan(pi / m)});
  }
  for (const std::size_t n : {4, 5, 6, 7, 8, 9, 12, 15, 16, 17, 31, 48}) {
    const auto m = static_cast<double>(n);
    const double root = std::sqrt(4 * std::pow(std::cos(pi / (2 * m)), 2) - 1);
    list.push_back({"antiprism" + std::to_string(n), 2 * n, 4 * n, 2 * n + 2,
                    m * root * std::sin(3 * pi / (2 * m)) / (12 * std::pow(std::sin(pi / m), 2))});
  }
  return list;
}

TEST(NamedSolids, HaveTheFeaturesOfTheirNames) {
  for (const Expected& expected : expected_solids()) {
    const auto solid = Solid::named(expected.name);
    ASSERT_TRUE(solid) << expected.name;
    EXPECT_EQ((*solid)->vertices().size(), expected.vertices) << expected.name;
    EXPECT_EQ((*solid)->edges().size(), expected.edges) << expected.name;
    EXPECT_EQ((*solid)->faces().size(), expected.faces) << expected.name;
    const Edge& first = (*solid)->edges().front();
    const double edge = ((*solid)->vertices()[first.head] - (*solid)->vertices()[first.tail]).norm();
    EXPECT_NEAR(edge * std::cbrt(expected.volume), 1, 16 * eps) << expected.name << ": edge of unit volume";
  }
}

TEST(NamedSolids, HaveEdgesOfOneLengthToTheLastDigit) {
  for (const Expected& expected : expected_solids()) {
    const SolidArrays& arrays = (*Solid::named(expected.name))->arrays();
    const auto length = [&](const Edge& edge) { return norm(arrays.vertex(edge.head) - arrays.vertex(edge.tail)); };
    const std::vector<Edge>& edges = (*Solid::named(expected.name))->edges();
    for (std::size_t e = 1; e < edges.size(); ++e) {
      EXPECT_LE(std::abs(static_cast<double>(length(edges[e]) - length(edges[0]))), 1e-30)
          << expected.name << " edge " << e;
    }
  }
}

TEST(NamedSolids, HaveNoOtherNames) {
  for (const char* name : {"", "sphere", "prism", "prism4", "prism2", "prism65", "prism06", "prism6a", "prism-6",
                           "antiprism3", "antiprism49", "Cube", "prism99999999999999999999"})
    EXPECT_FALSE(Solid::named(name)) << name;
}

/// Index of the point that the error names; −1 if it names none, −2 if there is no error.
int blamed(const Points& points) {
  try {
    const ConvexSolid solid("x", points);
    return -2;
  } catch (const NoSolid& error) {
    return error.vertex();
  }
}

TEST(Hull, ErrorNamesThePointThatIsNoVertex) {
  const Points cube = platonic(SolidKind::cube).vertices();
  const auto with = [&](const Vector3d& point) {
    Points points = cube;
    points.insert(points.begin() + 3, point);
    return points;
  };
  EXPECT_EQ(blamed(cube), -2);
  EXPECT_EQ(blamed(with({0, 0, 0})), 3) << "inside";
  EXPECT_EQ(blamed(with({.5, .1, -.2})), 3) << "on a face";
  EXPECT_EQ(blamed(with({.5, .5, .1})), 3) << "on an edge";
  EXPECT_EQ(blamed(with({.5 - 1e-9, .5, .1})), 3) << "just within";
  EXPECT_EQ(blamed(with(cube[0])), 3) << "twice";
  EXPECT_EQ(blamed(with({0, .1, .8})), -2) << "outside: another solid";
  EXPECT_EQ(blamed(with({.6, .6, .6})), 8) << "a corner comes to lie inside";
  EXPECT_EQ(blamed({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}}), -1) << "flat";
}

/// Text of the error; empty if the solid is accepted.
std::string refusal(const Points& points) {
  try {
    const ConvexSolid solid("x", points);
    return {};
  } catch (const NoSolid& error) {
    EXPECT_EQ(error.vertex(), -1) << "none of them more than another";
    return error.what();
  }
}

TEST(Hull, IsRejectedWithMoreFeaturesThanTheLimits) {
  RandomStream random{62};
  Points points;
  while (points.size() < 64) {
    const Vector3d point = Vector3d(random.normal(), random.normal(), random.normal()).normalized();
    if (point.z() < .9) points.push_back(point);
  }
  const auto with_top = [&](int vertices, int corners) {
    Points all(points.begin(), points.begin() + (vertices - corners));
    for (int k = 0; k < corners; ++k)
      all.emplace_back(.3 * std::cos(2 * pi * k / corners), .3 * std::sin(2 * pi * k / corners), .95);
    return all;
  };
  // All faces except the top are triangles: E = 3V − 6 − (corners − 3) and F = 2V − 4 − (corners − 3).
  EXPECT_EQ(refusal(with_top(66, 3)), "") << "192 edges, 128 faces";
  EXPECT_EQ(refusal(with_top(67, 6)), "") << "192 edges, 127 faces";
  const std::string limits = " faces, but at most 192 edges and 128 faces are allowed";
  EXPECT_EQ(refusal(with_top(67, 5)), "the solid has 193 edges and 128" + limits);
  EXPECT_EQ(refusal(with_top(67, 4)), "the solid has 194 edges and 129" + limits);
  Points many;
  for (int k = 0; k < 129; ++k) many.emplace_back(std::cos(k), std::sin(k), .01 * k);
  EXPECT_EQ(refusal(many), "the solid has 129 vertices, but at most 128 are allowed");
}

TEST(Inertia, OfABoxIsThatOfTextbooks) {
  const Vector3d edges(1, 1.5, 2);
  Points points;
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(.7, Vector3d(1, 2, 3).normalized()).toRotationMatrix();
  for (int k = 0; k < 8; ++k)
    points.emplace_back(turn * edges.cwiseProduct(Vector3d(k & 1 ? 1 : 0, k & 2 ? 1 : 0, k & 4 ? 1 : 0)));
  const ConvexSolid box("box", points);
  const Vector3d unit = edges / std::cbrt(edges.prod());
  const Vector3d moments = (Vector3d::Constant(unit.squaredNorm()) - unit.cwiseAbs2()) / 12;
  EXPECT_LE((box.inertia() - turn * moments.asDiagonal() * turn.transpose()).norm(), 16 * eps);
  EXPECT_NEAR(box.gyration_radius(), std::sqrt(moments.mean()), 16 * eps);
  EXPECT_FALSE(box.is_spherical_top());
}

TEST(Inertia, IdentifiesSphericalTops) {
  for (const std::string_view name : named_solids()) {
    const Solid solid = *Solid::named(name);
    EXPECT_TRUE(solid->is_spherical_top()) << name << "\n" << solid->inertia();
    EXPECT_NEAR(solid->inertia()(0, 0), std::pow(solid->gyration_radius(), 2), 16 * eps) << name;
  }
  EXPECT_FALSE((*Solid::named("prism6"))->is_spherical_top());
}

TEST(SolidTest, IsTheSameForEqualNamesAndVertices) {
  const Points points = platonic(SolidKind::cube).vertices();
  const Solid one = Solid::made_of("mine", points), again = Solid::made_of("mine", points);
  EXPECT_EQ(&*one, &*again);
  EXPECT_TRUE(one.is_defined());
  EXPECT_NE(one, Solid::made_of("yours", points));
  EXPECT_NE(one, Solid(SolidKind::cube));
  EXPECT_EQ(*Solid::named("cube"), Solid(SolidKind::cube));
  EXPECT_EQ(*Solid::named("prism5"), *Solid::named("prism5"));
  EXPECT_EQ(Solid::of(*one), one);
}

TEST(SolidTest, OrderIsAsDocumented) {
  const Points points = platonic(SolidKind::cube).vertices();
  Points other = points;
  for (Vector3d& v : other) v *= 2;
  std::vector<Solid> ascending;
  for (const std::string_view name : named_solids()) ascending.push_back(*Solid::named(name));
  ascending.push_back(*Solid::named("antiprism5"));
  ascending.push_back(*Solid::named("prism6"));
  ascending.push_back(Solid::made_of("a", points));
  ascending.push_back(Solid::made_of("a", other));
  ascending.push_back(Solid::made_of("b", points));
  if (ascending[ascending.size() - 2] < ascending[ascending.size() - 3])
    std::swap(ascending[ascending.size() - 2],
              ascending[ascending.size() - 3]);  // equal names: sorted by vertices
  for (std::size_t i = 0; i < ascending.size(); ++i) {
    for (std::size_t j = 0; j < ascending.size(); ++j)
      EXPECT_EQ(ascending[i] < ascending[j], i < j) << to_string(ascending[i]) << " " << to_string(ascending[j]);
  }
}

}  // namespace
}  // namespace isojam
