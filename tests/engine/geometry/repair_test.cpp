#include "engine/geometry/repair.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <cstdio>
#include <cstdlib>

#include "engine/geometry/hull.hpp"
#include "engine/geometry/solids/named_solids.hpp"
#include "engine/geometry/solids/solid.hpp"
#include "engine/random/stream.hpp"

namespace isojam {
namespace {

using Eigen::Vector3d;
using Points = std::vector<Vector3d>;

Vector3d noise(double size, RandomStream& random) {
  return size * Vector3d(2 * random.uniform() - 1, 2 * random.uniform() - 1, 2 * random.uniform() - 1);
}

Points built_in(const std::string& name) {
  Points points;
  const std::vector<Quad3> vertices = *named_vertices(name);
  for (const Quad3& v : vertices) points.push_back(rounded(v));
  return points;
}

/// Points of an n × n grid on each side of a cube with edges of length 2.
Points subdivided_cube(int n) {
  Points points;
  for (int i = 0; i <= n; ++i) {
    for (int j = 0; j <= n; ++j) {
      for (int k = 0; k <= n; ++k) {
        if (i % n == 0 || j % n == 0 || k % n == 0) points.push_back(2.0 / n * Vector3d(i, j, k) - Vector3d::Ones());
      }
    }
  }
  return points;
}

int named_point(const Points& points, const RepairOptions& options) {
  try {
    repaired(points, options);
  } catch (const NoSolid& error) {
    return error.vertex();
  }
  return -2;
}

TEST(Repair, ChangesNothingThatNeedsNoRepair) {
  RandomStream random{94};
  for (const std::string_view name : named_solids()) {
    Points points = built_in(std::string(name));
    for (Vector3d& p : points) p += Vector3d(3, 5, 7);
    for (const RepairOptions& options : {RepairOptions{}, RepairOptions{.merge = 1e-6}, RepairOptions{.hull = true},
                                         RepairOptions{.corners = static_cast<int>(points.size())}}) {
      const RepairedSolid same = repaired(points, options);
      EXPECT_TRUE(same.vertices == points) << name;
      EXPECT_EQ(same.report.welded + same.report.dropped + same.report.joined_faces + same.report.removed_corners, 0);
      EXPECT_EQ(same.report.largest_move, 0);
      EXPECT_NEAR(same.report.volume_change, 0, 1e-14);
    }
  }
}

TEST(Repair, NamesThePointThatIsNoCorner) {
  Points cube = built_in("cube");
  cube.insert(cube.begin() + 3, .5 * (cube[0] + cube[1]));
  EXPECT_EQ(named_point(cube, {}), 3);
  EXPECT_EQ(repaired(cube, {.merge = 1e-6}).report.dropped, 1) << "it is within `merge` of a face";
  EXPECT_EQ(named_point(cube, {.corners = 6}), 3);
  EXPECT_EQ(repaired(cube, {.hull = true}).report.dropped, 1);
  cube[3] = cube[5];
  EXPECT_EQ(named_point(cube, {}), 5);
  EXPECT_EQ(repaired(cube, {.merge = 1e-6}).report.welded, 1);
  EXPECT_EQ(repaired(cube, {.hull = true}).vertices.size(), 8U);
}

TEST(Repair, JoinsSubdividedFaces) {
  RandomStream random{96};
  for (const double size : {1e-12, 1e-9, 1e-6, 1e-4}) {
    for (const int n : {2, 3, 5}) {
      Points points = subdivided_cube(n);
      for (Vector3d& p : points) p += noise(size, random);
      const RepairedSolid repair = repaired(points, {.merge = 4 * size, .hull = true});
      const ConvexSolid cube("cube", repair.vertices);
      EXPECT_EQ(cube.vertices().size(), 8U) << size << ", " << n;
      EXPECT_EQ(cube.faces().size(), 6U) << size << ", " << n;
      EXPECT_LT(std::abs(repair.report.volume_change), 10 * size);
      EXPECT_EQ(repair.report.dropped, static_cast<int>(points.size()) - 8) << size << ", " << n;
      const RepairedSolid again = repaired(repair.vertices, {.merge = 4 * size});
      EXPECT_TRUE(again.vertices == repair.vertices) << size << ", " << n;
    }
  }
  Points cut = built_in("cube");
  const Vector3d corner = cut.back();
  cut.pop_back();
  for (int c = 0; c < 3; ++c) cut.emplace_back(corner - .1 * corner[c] * Vector3d::Unit(c));
  EXPECT_EQ(repaired(cut, {.merge = 1e-3}).vertices.size(), 10U);
}

TEST(Repair, ReducesStones) {
  RandomStream random{97};
  Points stone;
  for (int k = 0; k < 1000; ++k) {
    const Vector3d p = Vector3d(random.normal(), random.normal(), random.normal()).normalized();
    stone.push_back(p.cwiseProduct(Vector3d(1, .8, .6)) + noise(.02, random));
  }
  EXPECT_GE(named_point(stone, {.corners = 24}), 0);
  double before = 0;
  for (const int corners : {66, 48, 24, 12, 4}) {
    const RepairedSolid repair = repaired(stone, {.hull = true, .corners = corners, .max_volume_change = 1});
    EXPECT_EQ(repair.vertices.size(), static_cast<std::size_t>(corners));
    EXPECT_EQ(repair.report.dropped + repair.report.removed_corners + corners, 1000);
    EXPECT_LT(repair.report.volume_change, before);
    before = repair.report.volume_change;
    std::printf("%d corners: the volume changes by %.1f %%\n", corners, 100 * before);
    for (const Vector3d& v : repair.vertices) EXPECT_NE(std::find(stone.begin(), stone.end(), v), stone.end());
    EXPECT_EQ(ConvexSolid("stone", repair.vertices).vertices().size(), repair.vertices.size());
  }
}

Vector3d written(const Vector3d& p, int digits) {
  return p.unaryExpr([&](double x) {
    char text[64];
    std::snprintf(text, sizeof text, "%.*e", digits - 1, x);
    return digits > 0 ? std::strtod(text, nullptr) : static_cast<double>(static_cast<float>(x));
  });
}

TEST(SolidShape, SuggestsAMergeThatJoinsFaces) {
  const Eigen::Quaterniond turn(Eigen::AngleAxisd(.7, Vector3d(1, 2, 3).normalized()));
  for (const auto* name : {"cube", "dodecahedron", "rhombic_dodecahedron", "prism7", "antiprism8"}) {
    const Solid exact = *Solid::named(name);
    const SolidShape shape = shape_of(*exact);
    EXPECT_EQ(shape.suggested_merge, 0) << name;
    EXPECT_LE(shape.largest_distance, 1e-30) << name;
    EXPECT_NEAR(shape.volume, 1, 1e-15) << name;
    for (const int digits : {0, 6, 9}) {  // 0: single precision
      Points points = built_in(name);
      for (Vector3d& p : points) p = written(10 * (turn * p), digits);
      const SolidShape rough = shape_of(ConvexSolid("rough", points));
      EXPECT_GT(rough.faces, shape.faces) << name << ", " << digits;
      EXPECT_LT(rough.smallest_angle, 1e-3) << name << ", " << digits;
      EXPECT_GT(rough.suggested_merge, 0) << name << ", " << digits;
      const ConvexSolid joined("joined", repaired(points, {.merge = rough.suggested_merge}).vertices);
      const SolidShape repair = shape_of(joined);
      EXPECT_EQ(repair.faces, shape.faces) << name << ", " << digits;
      EXPECT_EQ(repair.edges, shape.edges) << name << ", " << digits;
      EXPECT_EQ(repair.suggested_merge, 0) << name << ", " << digits;
      EXPECT_NEAR(repair.smallest_angle, shape.smallest_angle, 1e-4) << name << ", " << digits;
      EXPECT_NEAR(repair.volume / rough.volume, 1, 1e-5) << name << ", " << digits;
      std::printf("%s, %d digits: merge %g\n", name, digits, rough.suggested_merge);
    }
  }
}

}  // namespace
}  // namespace isojam
