#include "engine/geometry/hull.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <cstdio>
#include <numeric>
#include <set>

#include "engine/geometry/corner_removal.hpp"
#include "engine/geometry/solids/named_solids.hpp"
#include "engine/random/stream.hpp"

namespace isojam {
namespace {

using Eigen::Vector3d;

std::vector<Quad3> widened(const std::vector<Vector3d>& points) {
  std::vector<Quad3> result;
  for (const Vector3d& p : points) result.push_back({p.x(), p.y(), p.z()});
  return result;
}

std::vector<int> all_of(const HullPoints& points) {
  std::vector<int> all(static_cast<std::size_t>(points.size()));
  std::iota(all.begin(), all.end(), 0);
  return all;
}

std::vector<Vector3d> on_sphere(int n, RandomStream& random) {
  std::vector<Vector3d> points;
  for (int k = 0; k < n; ++k)
    points.push_back(Vector3d(random.normal(), random.normal(), random.normal()).normalized());
  return points;
}

void expect_hull(const std::vector<Vector3d>& points, const std::string& what) {
  const HullPoints exact(widened(points));
  const auto triangles = hull_triangles(exact, all_of(exact));
  std::set<std::pair<int, int>> edges;
  for (const HullTriangle& t : triangles) {
    for (std::size_t k = 0; k < 3; ++k) EXPECT_TRUE(edges.insert({t[k], t[(k + 1) % 3]}).second) << what;
    for (int p = 0; p < exact.size(); ++p) EXPECT_LE(exact.side(t[0], t[1], t[2], p), 0) << what << ", point " << p;
  }
  for (const auto& [from, to] : edges) EXPECT_TRUE(edges.contains({to, from})) << what;
}

TEST(HullTriangles, HaveNoPointAbove) {
  RandomStream random{81};
  for (int k = 0; k < 10; ++k) expect_hull(on_sphere(50, random), "sphere");
  std::vector<Vector3d> grid, skew;
  for (int k = 0; k < 64; ++k) {
    const int z = k / 16;
    const Vector3d p(k % 4, k / 4 % 4, z);
    grid.push_back(p);
    skew.push_back({.1 * p.x() + .3 * p.y(), .7 * p.y() - .2 * p.z(), .3 * p.z() + .1 * p.x()});
  }
  expect_hull(grid, "grid");
  expect_hull(skew, "rounded grid");
  for (const double noise : {1e-3, 1e-10, 1e-16, 1e-30}) {
    std::vector<Vector3d> flat, thin;
    for (int k = 0; k < 40; ++k) {
      flat.emplace_back(random.normal(), random.normal(), noise * random.normal());
      thin.emplace_back(k, noise * random.normal(), noise * random.normal());
    }
    expect_hull(flat, "flat by " + std::to_string(std::log10(noise)));
    expect_hull(thin, "thin by " + std::to_string(std::log10(noise)));
  }
}

/// All sets of three or more points in one plane that have all other points on one side, sorted.
std::set<std::vector<int>> faces_of_triples(const std::vector<Quad3>& points, Quad tolerance) {
  std::set<std::vector<int>> faces;
  const int n = static_cast<int>(points.size());
  for (int a = 0; a < n; ++a) {
    for (int b = a + 1; b < n; ++b) {
      for (int c = b + 1; c < n; ++c) {
        Quad3 normal = cross(points[b] - points[a], points[c] - points[a]);
        normal = (1 / norm(normal)) * normal;
        std::vector<int> on;
        bool above = false, below = false;
        for (int p = 0; p < n; ++p) {
          const Quad height = dot(normal, points[p] - points[a]);
          if (height <= tolerance && height >= -tolerance) {
            on.push_back(p);
          } else {
            (height > 0 ? above : below) = true;
          }
        }
        if (!above || !below) faces.insert(on);
      }
    }
  }
  return faces;
}

TEST(HullFaces, AreThoseOfASearchOverAllTriples) {
  RandomStream random{82};
  int solids = 0;
  const auto check = [&](const std::vector<Quad3>& points, const std::string& what) {
    std::set<std::vector<int>> found;
    for (FaceLoop face : hull_faces(points)) {
      EXPECT_EQ(face.front(), *std::min_element(face.begin(), face.end())) << what;
      std::sort(face.begin(), face.end());
      found.insert(face);
    }
    EXPECT_EQ(found, faces_of_triples(points, rounding_tolerance(points))) << what;
    ++solids;
  };
  for (const auto* name : {"cube", "dodecahedron", "truncated_cube", "prism21", "antiprism16", "rhombic_dodecahedron"})
    check(*named_vertices(name), name);
  for (int k = 0; k < 20; ++k) check(widened(on_sphere(20, random)), "sphere " + std::to_string(k));
  std::printf("%d solids have the faces of all triples\n", solids);
}

double volume(const HullPoints& points, const std::vector<HullTriangle>& triangles) {
  double sum = 0;
  for (const HullTriangle& t : triangles) sum += points.near(t[0]).dot(points.near(t[1]).cross(points.near(t[2]))) / 6;
  return sum;
}

std::set<int> corners_of(const std::vector<HullTriangle>& triangles) {
  std::set<int> corners;
  for (const HullTriangle& t : triangles) corners.insert(t.begin(), t.end());
  return corners;
}

TEST(CornerRemoval, RemovesTheCornerThatChangesTheVolumeLeast) {
  RandomStream random{84};
  for (int sample = 0; sample < 10; ++sample) {
    std::vector<Vector3d> stone = on_sphere(24, random);
    for (Vector3d& p : stone) p = p.cwiseProduct(Vector3d(1, .8, .6));
    const HullPoints points(widened(stone));
    std::vector<HullTriangle> triangles = hull_triangles(points, all_of(points));
    for (int left = 23; left >= 4; --left) {
      const std::set<int> before = corners_of(triangles);
      double best = 0;
      for (const int without : before) {
        std::vector<int> use;
        std::copy_if(before.begin(), before.end(), std::back_inserter(use), [&](int v) { return v != without; });
        best = std::max(best, volume(points, hull_triangles(points, use)));
      }
      triangles = without_smallest_corners(points, triangles, left);
      EXPECT_EQ(corners_of(triangles).size(), static_cast<std::size_t>(left));
      EXPECT_NEAR(volume(points, triangles), best, 1e-14) << left << " corners";
      for (const HullTriangle& t : triangles) {
        for (const int v : corners_of(triangles)) EXPECT_LE(points.side(t[0], t[1], t[2], v), 0) << left << " corners";
      }
    }
  }
}

}  // namespace
}  // namespace isojam
