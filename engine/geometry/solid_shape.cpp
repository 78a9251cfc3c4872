#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "engine/arithmetic/elementary.hpp"
#include "engine/geometry/hull.hpp"
#include "engine/geometry/planar_faces.hpp"
#include "engine/geometry/repair.hpp"

namespace isojam {

namespace {

double angle_at(const SolidArrays& arrays, const Edge& edge) {
  const Quad3 left = arrays.normal(edge.left), right = arrays.normal(edge.right);
  return nearest::atan2(static_cast<double>(norm(cross(left, right))), static_cast<double>(dot(left, right)));
}

/// The vertices with which a solid was constructed, relative to their mean.
std::vector<Quad3> given_vertices(const ConvexSolid& solid) {
  std::vector<Quad3> vertices;
  for (const Eigen::Vector3d& v : solid.given()) vertices.push_back({v.x(), v.y(), v.z()});
  if (vertices.empty()) {
    for (int v = 0; v < solid.arrays().vertices; ++v) vertices.push_back(solid.arrays().vertex(v));
  }
  const Quad3 mean = mean_of(vertices);
  for (Quad3& v : vertices) v = v - mean;
  return vertices;
}

std::vector<FaceLoop> loops_of(const ConvexSolid& solid) {
  std::vector<FaceLoop> loops;
  for (const Face& face : solid.faces()) loops.push_back(face.vertices);
  return loops;
}

Quad volume_of(std::span<const Quad3> vertices, std::span<const FaceLoop> faces) {
  Quad sum = 0;
  for (const FaceLoop& face : faces) {
    const auto at = [&](std::size_t k) { return vertices[static_cast<std::size_t>(face[k])]; };
    for (std::size_t k = 1; k + 1 < face.size(); ++k) sum += dot(at(0), cross(at(k), at(k + 1))) / 6;
  }
  return sum;
}

/// For each face, the smallest face of its group. Edges with angles below suspect_angle connect the faces of a group.
std::vector<std::size_t> flat_groups(const ConvexSolid& solid) {
  std::vector<std::size_t> group(solid.faces().size());
  std::iota(group.begin(), group.end(), std::size_t{0});
  for (const Edge& edge : solid.edges()) {
    if (angle_at(solid.arrays(), edge) >= suspect_angle) continue;
    const auto left = static_cast<std::size_t>(edge.left), right = static_cast<std::size_t>(edge.right);
    const std::size_t from = std::max(group[left], group[right]), to = std::min(group[left], group[right]);
    std::replace(group.begin(), group.end(), from, to);
  }
  return group;
}

/// The smallest number of the form d·10^k with one digit d that is at least x.
double rounded_up(double x) {
  const double power = nearest::pow(10, std::floor(nearest::log10(x)));
  return std::ceil(x / power * (1 - 1e-12)) * power;
}

bool has_suspect_edges(const ConvexSolid& solid) {
  return std::any_of(solid.edges().begin(), solid.edges().end(),
                     [&](const Edge& edge) { return angle_at(solid.arrays(), edge) < suspect_angle; });
}

/// Largest distance of a corner from the common plane of a group of faces, relative to the diameter.
double group_distance(const ConvexSolid& solid) {
  const std::vector<std::size_t> group = flat_groups(solid);
  double largest = 0;
  for (std::size_t g = 0; g < group.size(); ++g) {
    if (std::count(group.begin(), group.end(), g) < 2) continue;
    FacePlane plane;
    std::vector<int> corners;
    for (std::size_t f = 0; f < group.size(); ++f) {
      if (group[f] != g) continue;
      const FaceLoop& face = solid.faces()[f].vertices;
      for (std::size_t k = 0; k < face.size(); ++k)
        plane.normal =
            plane.normal + cross(solid.arrays().vertex(face[k]), solid.arrays().vertex(face[(k + 1) % face.size()]));
      corners.insert(corners.end(), face.begin(), face.end());
    }
    plane.normal = (1 / norm(plane.normal)) * plane.normal;
    std::sort(corners.begin(), corners.end());
    corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
    for (const int v : corners) plane.offset += dot(plane.normal, solid.arrays().vertex(v)) / Quad(corners.size());
    for (const int v : corners) {
      const Quad height = dot(plane.normal, solid.arrays().vertex(v)) - plane.offset;
      largest = std::max(largest, std::abs(static_cast<double>(height)) / solid.diameter());
    }
  }
  return largest;
}

double suggested_merge(const ConvexSolid& solid) {
  if (solid.given().empty() || !has_suspect_edges(solid)) return 0;
  const auto mends = [&](double merge) {
    try {
      return !has_suspect_edges(ConvexSolid("", repaired(solid.given(), {.merge = merge}).vertices));
    } catch (const NoSolid&) {
      return false;  // a larger value joins more faces
    }
  };
  // Faces are joined in pairs, and the plane of a part of them may be farther from its corners.
  double merge = rounded_up(std::max(2 * group_distance(solid), 1e-15));
  while (merge <= largest_merge && !mends(merge)) merge *= 2;
  return merge <= largest_merge ? merge : 0;
}

}  // namespace

SolidShape shape_of(const ConvexSolid& solid) {
  const std::vector<FaceLoop> loops = loops_of(solid);
  const std::vector<Quad3> vertices = given_vertices(solid);
  SolidShape shape{.faces = static_cast<int>(solid.faces().size()),
                   .edges = static_cast<int>(solid.edges().size()),
                   .vertices = static_cast<int>(solid.vertices().size()),
                   .volume = static_cast<double>(volume_of(vertices, loops)),
                   .smallest_angle = std::numbers::pi};
  Quad diameter = 0;
  for (const Quad3& p : vertices) {
    for (const Quad3& q : vertices) diameter = std::max(diameter, norm(p - q));
  }
  for (const FaceLoop& face : loops) {
    const FacePlane plane = fitted_plane(face, vertices);
    for (const int v : face) {
      const Quad height = dot(plane.normal, vertices[static_cast<std::size_t>(v)]) - plane.offset;
      shape.largest_distance = std::max(shape.largest_distance, std::abs(static_cast<double>(height / diameter)));
    }
  }
  for (const Edge& edge : solid.edges()) {
    const double angle = angle_at(solid.arrays(), edge);
    if (angle >= shape.smallest_angle) continue;
    shape.smallest_angle = angle;
    shape.angle_faces = {edge.left, edge.right};
  }
  if (!solid.given().empty())
    shape.tolerance = static_cast<double>(rounding_tolerance(widened(solid.given())) / diameter);
  shape.suggested_merge = suggested_merge(solid);
  return shape;
}

}  // namespace isojam
