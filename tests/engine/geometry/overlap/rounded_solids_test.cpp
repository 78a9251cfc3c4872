// Reference: clipping in quadruple precision, which uses the planes of the faces and no vertices. Vertices that are
// written with few digits make faces that are planar only within rounding.

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <vector>

#include "engine/geometry/repair.hpp"
#include "engine/geometry/solids/named_solids.hpp"
#include "tests/engine/geometry/overlap/pair_truth.hpp"
#include "tests/engine/geometry/overlap/pairs.hpp"

namespace isojam {
namespace {

using namespace testing_pairs;
using Eigen::Vector3d;

std::vector<Vector3d> turned(const std::string& name, RandomStream& random) {
  const Eigen::Quaterniond turn = random_orientation(random);
  std::vector<Vector3d> points;
  const std::vector<Quad3> vertices = *named_vertices(name);
  for (const Quad3& v : vertices) points.push_back(turn * rounded(v));
  return points;
}

/// x with this number of digits, or in single precision if it is 0.
double written(double x, int digits) {
  if (digits == 0) return static_cast<float>(x);
  char text[64];
  std::snprintf(text, sizeof text, "%.*e", digits - 1, x);
  return std::strtod(text, nullptr);
}

std::vector<ConvexSolid> made() {
  RandomStream random{61};
  std::vector<ConvexSolid> solids;
  const auto add = [&](const std::string& name, const std::string& how, const std::vector<Vector3d>& points) {
    solids.emplace_back(name + " " + how, points);
    if (random.uniform() < .3) solids.back() = ConvexSolid(solids.back(), 1 + 9 * random.uniform());
  };
  for (const auto* name : {"prism7", "dodecahedron", "cube", "antiprism8"}) {
    for (const double distance : {0.0, 1e4, 1e6, 1e8}) {
      std::vector<Vector3d> points = turned(name, random);
      const Vector3d origin = distance * random_direction(random);
      for (Vector3d& p : points) p += origin;
      add(name, "at " + std::to_string(distance), points);
    }
    for (const int digits : {0, 6, 9, 12, 15}) {
      std::vector<Vector3d> points = turned(name, random);
      for (Vector3d& p : points) p = p.unaryExpr([&](double x) { return written(x, digits); });
      add(name, "of " + std::to_string(digits) + " digits",
          repaired(points, {.merge = 20 * std::pow(10, -(digits > 0 ? digits : 6))}).vertices);
    }
  }
  for (const double size : {1e-9, 1e9}) {
    std::vector<Vector3d> points = turned("truncated_cube", random);
    for (Vector3d& p : points) p *= size;
    add("truncated_cube", "of size " + std::to_string(size), points);
  }
  return solids;
}

const std::vector<ConvexSolid>& solids() {
  static const std::vector<ConvexSolid> all = made();
  return all;
}

template <class Visit>
void for_each_pair(const Visit& visit) {
  for (std::size_t i = 0; i < solids().size(); ++i) {
    for (std::size_t j = i; j < solids().size(); ++j) visit(solids()[i], solids()[j]);
  }
}

TEST(RoundedSolids, AreRightWhereFacesMeet) {
  RandomStream random{62};
  int pairs = 0;
  expect_flat_contacts_right(
      [&](const auto& visit) {
        for_each_pair([&](const ConvexSolid& a, const ConvexSolid& b) {
          for (int k = 0; k < 2; ++k) visit(a, b);
          pairs += 2 * 9;
        });
      },
      random);
  EXPECT_GT(pairs, 10000);
}

TEST(RoundedSolids, AreRightWhereCornersAndEdgesMeet) {
  RandomStream random{63};
  PointedContacts contacts{.limit = 5e-12};
  int turn = 0;
  for_each_pair([&](const ConvexSolid& a, const ConvexSolid& b) {
    const double volume = std::pow(10, -3 - 12 * random.uniform());
    const auto approach = ++turn % 2 == 0 ? corner_over_face : edge_over_edge;
    contacts.expect_right(approach(a, b, random), volume);
  });
  contacts.expect_more_than(500);
}

}  // namespace
}  // namespace isojam
