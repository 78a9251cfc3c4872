// Reference: clipping in quadruple precision. The numbers of features are at the limits of 64-bit words.

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "engine/geometry/overlap/contact_loop.hpp"
#include "engine/geometry/solids/solid.hpp"
#include "tests/engine/geometry/overlap/pair_truth.hpp"
#include "tests/engine/geometry/overlap/pairs.hpp"

namespace isojam {
namespace {

using namespace testing_pairs;
using Eigen::Vector3d;

const Quad golden = (1 + square_root(5)) / 2;

enum class Signs { all, odd };

/// Adds the even permutations of (±x, ±y, ±z), with all signs or with an odd number of minus signs. Coordinates that
/// are 0 have one sign.
void add_points(std::vector<Quad3>& points, Signs signs, const Quad3& p) {
  for (unsigned minus = 0; minus < 8; ++minus) {
    Quad3 q = p;
    bool repeated = false;
    for (unsigned c = 0; c < 3; ++c) {
      if ((minus >> c & 1) == 0) continue;
      repeated |= q[c] == 0;
      q[c] = -q[c];
    }
    const bool odd = minus == 1 || minus == 2 || minus == 4 || minus == 7;
    if (repeated || (signs == Signs::odd && !odd)) continue;
    points.push_back(q);
    points.push_back({q[1], q[2], q[0]});
    points.push_back({q[2], q[0], q[1]});
  }
}

ConvexSolid made(const std::string& name, Signs signs, const std::vector<Quad3>& orbits) {
  std::vector<Quad3> points;
  for (const Quad3& p : orbits) add_points(points, signs, p);
  return ConvexSolid(name, points);
}

ConvexSolid truncated_icosidodecahedron() {
  const Quad g = golden, h = 1 / g;
  return made("truncated icosidodecahedron", Signs::all,
              {{h, h, 3 + g}, {2 * h, g, 1 + 2 * g}, {h, g * g, 3 * g - 1}, {2 * g - 1, 2, 2 + g}, {g, 3, 2 * g}});
}

ConvexSolid rhombicosidodecahedron() {
  const Quad g = golden;
  return made("rhombicosidodecahedron", Signs::all, {{1, 1, g * g * g}, {g * g, g, 2 * g}, {2 + g, 0, g * g}});
}

/// ξ solves ξ³ − 2ξ = golden ratio.
ConvexSolid snub_dodecahedron() {
  const Quad g = golden;
  Quad x = 1.7155615;
  for (int k = 0; k < 8; ++k) x = x - (x * x * x - 2 * x - g) / (3 * x * x - 2);
  const Quad a = x - 1 / x, b = x * g + g * g + g / x;
  return made("snub dodecahedron", Signs::odd,
              {{2 * a, 2, 2 * b},
               {a + b / g + g, -a * g + b + 1 / g, a / g + b * g - 1},
               {a + b / g - g, a * g - b + 1 / g, a / g + b * g + 1},
               {-a / g + b * g + 1, -a + b / g - g, a * g + b - 1 / g},
               {-a / g + b * g - 1, a - b / g - g, a * g + b + 1 / g}});
}

/// Random points on a sphere below a regular polygon. All faces except the polygon are triangles, so that a solid with
/// V vertices has 3V − 6 − (corners − 3) edges.
ConvexSolid with_top(int vertices, int corners, std::uint64_t seed) {
  RandomStream random{seed};
  std::vector<Vector3d> points;
  while (static_cast<int>(points.size()) < vertices - corners) {
    const Vector3d point = random_direction(random);
    if (point.z() < .9) points.push_back(point);
  }
  const double height = .95, radius = std::sqrt(1 - height * height);
  for (int k = 0; k < corners; ++k)
    points.emplace_back(radius * std::cos(2 * std::numbers::pi * k / corners),
                        radius * std::sin(2 * std::numbers::pi * k / corners), height);
  return ConvexSolid(std::to_string(vertices) + " vertices, top of " + std::to_string(corners), points);
}

struct Large {
  ConvexSolid solid;
  int edges, faces, vertices;
};

const std::vector<Large>& large_solids() {
  static const std::vector<Large> solids = [] {
    const ConvexSolid snub = snub_dodecahedron(), stone("stone of 66", points_on_sphere(66, 91));
    const auto named = [](const char* name) { return ConvexSolid(**Solid::named(name)); };
    return std::vector<Large>{{truncated_icosidodecahedron(), 180, 62, 120},
                              {snub, 150, 92, 60},
                              {dual("pentagonal hexecontahedron", snub), 150, 60, 92},
                              {rhombicosidodecahedron(), 120, 62, 60},
                              {named("prism32"), 96, 34, 64},
                              {named("prism64"), 192, 66, 128},
                              {named("antiprism48"), 192, 98, 96},
                              {stone, 192, 128, 66},
                              {dual("dual of the stone of 66", stone), 192, 66, 128},
                              {with_top(24, 4, 92), 65, 43, 24},
                              {with_top(45, 4, 93), 128, 85, 45},
                              {with_top(45, 3, 94), 129, 86, 45},
                              {with_top(34, 3, 95), 96, 64, 34},
                              {with_top(35, 4, 96), 98, 65, 35},
                              {with_top(65, 3, 97), 189, 126, 65}};
  }();
  return solids;
}

template <class Visit>
void for_each_pair(const Visit& visit) {
  const auto& large = large_solids();
  for (std::size_t k = 0; k < large.size(); ++k) {
    const ConvexSolid &solid = large[k].solid, &next = large[(k + 1) % large.size()].solid;
    visit(solid, solid);
    visit(solid, next);
    k % 2 == 0 ? visit(solid, platonic(SolidKind::octahedron)) : visit(platonic(SolidKind::cube), solid);
  }
}

TEST(LargeSolids, HaveTheirNumbersOfFeatures) {
  for (const Large& large : large_solids()) {
    EXPECT_EQ(large.solid.edges().size(), large.edges) << large.solid.name();
    EXPECT_EQ(large.solid.faces().size(), large.faces) << large.solid.name();
    EXPECT_EQ(large.solid.vertices().size(), large.vertices) << large.solid.name();
    EXPECT_GT(large.edges, wide_edges) << large.solid.name();
  }
  for (const ConvexSolid* solid : {&large_solids()[0].solid, &large_solids()[1].solid, &large_solids()[3].solid}) {
    double shortest = 1, longest = 0;
    for (const Edge& edge : solid->edges()) {
      const double length = (solid->vertices()[edge.head] - solid->vertices()[edge.tail]).norm();
      shortest = std::min(shortest, length), longest = std::max(longest, length);
    }
    EXPECT_NEAR(shortest / longest, 1, 1e-14) << solid->name() << " has edges of equal length";
  }
}

TEST(LargeSolids, AreRightWhereFacesMeet) {
  RandomStream random{98};
  expect_flat_contacts_right([](const auto& visit) { for_each_pair(visit); }, random);
}

TEST(LargeSolids, AreRightWhereCornersAndEdgesMeet) {
  RandomStream random{99};
  PointedContacts contacts{.with_features = true};
  FeatureSet faces{}, edges{};
  for_each_pair([&](const ConvexSolid& a, const ConvexSolid& b) {
    for (const double volume : {1e-3, 1e-7, 1e-11, 1e-15}) {
      for (const auto& approach : {random_approach, corner_over_face, edge_over_edge}) {
        if (const auto got = contacts.expect_right(approach(a, b, random), volume))
          faces |= got->faces_a, edges |= got->edges_a;
      }
    }
  });
  contacts.expect_more_than(450);
  EXPECT_LT(contacts.clipped, contacts.pairs / 50);
  for (const std::uint64_t word : edges.word) EXPECT_GT(std::popcount(word), 40) << "edges in every word";
  EXPECT_GT(std::popcount(faces.word[1]), 20);
}

/// ∂V/∂(x, θ) of both solids in quadruple precision.
std::pair<Vector6d, Vector6d> gradients(const PosedPair& pair) {
  const QuadOverlap here = exact(pair);
  const Quad3 moment_b = cross(displacement(pair), here.area) - here.moment;
  return {joined(rounded(here.area), rounded(here.moment)), joined(-rounded(here.area), rounded(moment_b))};
}

/// The pose moved by h along axis c, or rotated by h about axis c − 3.
Pose moved(Pose pose, int c, double h) {
  if (c < 3) {
    pose.position[c] += h;
  } else {
    pose.orientation =
        (Eigen::Quaterniond(Eigen::AngleAxisd(h, Vector3d::Unit(c - 3))) * pose.orientation).normalized();
  }
  return pose;
}

/// Largest difference between the blocks of the Hessian and differences of the gradients, relative to the blocks.
double worst_block(const PosedPair& pair) {
  OverlapHessian hessian;
  found(pair, hessian);
  constexpr double h = 1e-6;
  Matrix6d aa, ab, bb;
  for (int c = 0; c < 6; ++c) {
    const PosedPair up_a{pair.a, pair.b, moved(pair.at_a, c, h), pair.at_b};
    const PosedPair down_a{pair.a, pair.b, moved(pair.at_a, c, -h), pair.at_b};
    aa.col(c) = (gradients(up_a).first - gradients(down_a).first) / (2 * h);
    const PosedPair up_b{pair.a, pair.b, pair.at_a, moved(pair.at_b, c, h)};
    const PosedPair down_b{pair.a, pair.b, pair.at_a, moved(pair.at_b, c, -h)};
    const auto above = gradients(up_b), below = gradients(down_b);
    ab.col(c) = (above.first - below.first) / (2 * h);
    bb.col(c) = (above.second - below.second) / (2 * h);
  }
  const Matrix6d own_a = (aa + aa.transpose()) / 2, own_b = (bb + bb.transpose()) / 2;
  return std::max({(own_a - hessian.aa).norm() / own_a.norm(), (ab - hessian.ab).norm() / ab.norm(),
                   (own_b - hessian.bb).norm() / own_b.norm()});
}

TEST(LargeSolids, HaveAllBlocksOfTheHessian) {
  RandomStream random{101};
  double worst = 0;
  for (const Large& large : large_solids()) {
    const auto touching = at_volume(random_approach(large.solid, large.solid, random), 1e-3);
    ASSERT_TRUE(touching) << large.solid.name();
    const double here = worst_block(*touching);
    EXPECT_LE(here, 1e-8) << large.solid.name();
    worst = std::max(worst, here);
  }
  std::printf("blocks of the Hessian: %.1e at worst\n", worst);
}

TEST(LargeSolids, AreRightWhereTheyCoincide) {
  expect_coincident_right([](const auto& visit) {
    for (const Large& large : large_solids()) visit(large.solid);
  });
}

}  // namespace
}  // namespace isojam
