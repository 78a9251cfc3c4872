#include "engine/geometry/hull.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <queue>
#include <tuple>
#include <utility>

#include "engine/geometry/convex_solid.hpp"

namespace isojam {

namespace {

/// A plane through `point`; `normal` has unit length, or is 0 if the triangles of the face have no area.
struct PartPlane {
  DoubleDouble3 normal{}, point{};
  double height(const DoubleDouble3& p) const {
    DoubleDouble sum;
    for (std::size_t c = 0; c < 3; ++c) sum = sum + normal[c] * (p[c] - point[c]);
    return sum.high;
  }
};

/// A face that is being joined from triangles.
struct Part {
  Quad3 area{};               ///< sum of the area vectors of its triangles
  std::vector<int> vertices;  ///< sorted
  int changes = 0;            ///< number of times that it was joined
};

Part part_of(const FaceLoop& face, const HullPoints& points) {
  Part part{{}, face, 0};
  for (std::size_t k = 1; k + 1 < face.size(); ++k)
    part.area = part.area + cross(points[face[k]] - points[face[0]], points[face[k + 1]] - points[face[0]]);
  return part;
}

PartPlane plane_of(const Part& part, const HullPoints& points) {
  PartPlane plane;
  for (std::size_t c = 0; c < 3; ++c) {
    for (const int v : part.vertices) plane.point[c] = plane.point[c] + points.fine(v)[c];
    plane.point[c] = plane.point[c] / static_cast<double>(part.vertices.size());
  }
  const Quad size = norm(part.area);
  if (size > 0) plane.normal = narrowed((1 / size) * part.area);
  return plane;
}

double largest_distance(const Part& part, const HullPoints& points) {
  const PartPlane plane = plane_of(part, points);
  double largest = 0;
  for (const int v : part.vertices) largest = std::max(largest, std::abs(plane.height(points.fine(v))));
  return largest;
}

Part joined(const Part& a, const Part& b) {
  Part both{a.area + b.area, {}, 0};
  std::set_union(a.vertices.begin(), a.vertices.end(), b.vertices.begin(), b.vertices.end(),
                 std::back_inserter(both.vertices));
  return both;
}

/// Joins triangles to faces, the nearest pair first.
class Joining {
 public:
  Joining(const HullPoints& points, std::span<const HullTriangle> triangles, double tolerance)
      : points_(points), triangles_(triangles), tolerance_(tolerance), root_(triangles.size()) {
    std::iota(root_.begin(), root_.end(), std::size_t{0});
    for (const HullTriangle& t : triangles) {
      Part part = part_of({t[0], t[1], t[2]}, points);
      std::sort(part.vertices.begin(), part.vertices.end());
      parts_.push_back(std::move(part));
    }
    join_all();
  }

  /// Boundary edges of each face, as the vertex that follows each vertex.
  std::vector<std::map<int, int>> outlines() const {
    std::map<std::size_t, std::map<int, int>> of_root;
    for (std::size_t t = 0; t < triangles_.size(); ++t) {
      for (std::size_t k = 0; k < 3; ++k) {
        const int from = triangles_[t][k], to = triangles_[t][(k + 1) % 3];
        if (find(left_of_.at({to, from})) == find(t)) continue;
        if (!of_root[find(t)].emplace(from, to).second) throw NoSolid("the faces do not close a convex polyhedron");
      }
    }
    std::vector<std::map<int, int>> all;
    for (auto& [root, outline] : of_root) all.push_back(std::move(outline));
    return all;
  }

 private:
  /// A pair of faces that may be joined, with the numbers of changes at the time of the estimate.
  struct Candidate {
    double distance;
    std::size_t size, a, b;
    int changes;
    // The smallest distance is on top of the queue. Of equal distances, small faces come first: the time for one pair
    // is proportional to their sizes.
    bool operator<(const Candidate& other) const {
      return std::tie(distance, size, a, b) > std::tie(other.distance, other.size, other.a, other.b);
    }
  };

  std::size_t find(std::size_t t) const {
    while (root_[t] != t) t = root_[t];
    return t;
  }

  /// False if some corners show in double precision that no plane is near all of them. Faces in quite different planes
  /// need not be joined for that.
  bool may_join(const Part& a, const Part& b) const {
    const Part &small = a.vertices.size() < b.vertices.size() ? a : b, &large = &small == &a ? b : a;
    const Eigen::Vector3d normal = rounded(a.area + b.area);
    double low = std::numeric_limits<double>::infinity(), high = -low;
    const auto look_at = [&](int v) {
      const double height = normal.dot(points_.near(v));
      low = std::min(low, height), high = std::max(high, height);
    };
    for (const int v : small.vertices) look_at(v);
    for (std::size_t k = 0; k < 3; ++k) look_at(large.vertices[k]);
    return high - low <= 2 * (tolerance_ + 1e-15) * normal.norm();
  }

  void consider(std::size_t a, std::size_t b) {
    if (!may_join(parts_[a], parts_[b])) return;
    const Part both = joined(parts_[a], parts_[b]);
    const double distance = largest_distance(both, points_);
    if (distance <= tolerance_)
      queue_.push({distance, both.vertices.size(), a, b, parts_[a].changes + parts_[b].changes});
  }

  void join_all() {
    for (std::size_t t = 0; t < triangles_.size(); ++t) {
      for (std::size_t k = 0; k < 3; ++k) left_of_[{triangles_[t][k], triangles_[t][(k + 1) % 3]}] = t;
    }
    for (const auto& [ends, left] : left_of_) {
      if (ends.first < ends.second) consider(left, left_of_.at({ends.second, ends.first}));
    }
    while (!queue_.empty()) {
      const Candidate next = queue_.top();
      queue_.pop();
      const std::size_t a = find(next.a), b = find(next.b);
      if (a == b) continue;
      if (a != next.a || b != next.b || parts_[a].changes + parts_[b].changes != next.changes) {
        consider(a, b);
        continue;
      }
      const int changes = parts_[a].changes + parts_[b].changes + 1;
      parts_[a] = joined(parts_[a], parts_[b]);
      parts_[a].changes = changes;
      root_[b] = a;
    }
  }

  const HullPoints& points_;
  std::span<const HullTriangle> triangles_;
  double tolerance_;
  std::vector<std::size_t> root_;  ///< triangle that represents the face of each triangle, by find()
  std::vector<Part> parts_;        ///< of the representatives
  std::map<std::pair<int, int>, std::size_t> left_of_;  ///< the triangle in which an edge is directed in this way
  std::priority_queue<Candidate> queue_;
};

/// The outline as one polygon without the points in which fewer than three faces meet. Starts with the smallest index.
FaceLoop loop_of(const std::map<int, int>& outline, const std::vector<int>& face_count) {
  FaceLoop loop;
  std::size_t steps = 0;
  for (int v = outline.begin()->first; steps == 0 || v != outline.begin()->first; v = outline.at(v)) {
    if (face_count[static_cast<std::size_t>(v)] >= 3) loop.push_back(v);
    if (++steps > outline.size()) break;
  }
  if (steps != outline.size() || loop.size() < 3) throw NoSolid("the faces do not close a convex polyhedron");
  std::rotate(loop.begin(), std::min_element(loop.begin(), loop.end()), loop.end());
  return loop;
}

std::array<int, 3> three_smallest(const FaceLoop& face) {
  std::array<int, 3> smallest{};
  std::partial_sort_copy(face.begin(), face.end(), smallest.begin(), smallest.end());
  return smallest;
}

}  // namespace

Quad rounding_tolerance(std::span<const Quad3> points) {
  const Quad3 mean = mean_of(points);
  Quad largest = 0;
  for (const Quad3& point : points) {
    largest = std::max(largest, norm(point - mean));
    for (const Quad c : point) largest = std::max(largest, c < 0 ? -c : c);
  }
  return 64 * Quad(std::numeric_limits<double>::epsilon()) * largest;
}

std::vector<FaceLoop> joined_faces(const HullPoints& points, std::span<const HullTriangle> triangles,
                                   double tolerance) {
  const auto outlines = Joining(points, triangles, tolerance).outlines();
  std::vector<int> face_count(static_cast<std::size_t>(points.size()), 0);
  for (const auto& outline : outlines) {
    for (const auto& [from, to] : outline) ++face_count[static_cast<std::size_t>(from)];
  }
  std::vector<FaceLoop> faces;
  for (const auto& outline : outlines) faces.push_back(loop_of(outline, face_count));
  if (faces.size() < 4) throw NoSolid("all vertices are in one plane");
  std::sort(faces.begin(), faces.end(),
            [](const FaceLoop& a, const FaceLoop& b) { return three_smallest(a) < three_smallest(b); });
  return faces;
}

std::vector<std::size_t> welded(std::span<const Eigen::Vector3d> points, double distance) {
  const std::size_t none = points.size();
  std::vector<std::size_t> first(points.size(), none), order(points.size()), place(points.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return points[a].x() < points[b].x(); });
  for (std::size_t k = 0; k < order.size(); ++k) place[order[k]] = k;
  for (std::size_t k = 0; k < points.size(); ++k) {
    if (first[k] != none) continue;
    const auto take = [&](std::size_t other) {
      if (first[other] == none && (points[k] - points[other]).norm() <= distance) first[other] = k;
      return std::abs(points[k].x() - points[other].x()) <= distance;
    };
    first[k] = k;
    for (std::size_t at = place[k]; at-- > 0 && take(order[at]);) {
    }
    for (std::size_t at = place[k] + 1; at < order.size() && take(order[at]); ++at) {
    }
  }
  return first;
}

void refuse_equal_points(const HullPoints& points, double tolerance) {
  std::vector<Eigen::Vector3d> near;
  for (int k = 0; k < points.size(); ++k) near.push_back(points.near(k));
  // The coordinates near() are below 1/2, so their rounding errors are below 1e-16.
  const std::vector<std::size_t> first = welded(near, tolerance + 1e-15);
  for (int k = 0; k < points.size(); ++k) {
    const auto other = static_cast<int>(first[static_cast<std::size_t>(k)]);
    if (other != k && norm(points[k] - points[other]) <= tolerance)
      throw NoSolid("vertex " + std::to_string(k) + " is given twice: it is equal to vertex " + std::to_string(other),
                    NoSolid::Cause::equal_points, k);
  }
}

void refuse_other_points(const HullPoints& points, std::span<const int> use, std::span<const FaceLoop> faces,
                         double tolerance) {
  std::vector<bool> is_corner(static_cast<std::size_t>(points.size()), false);
  for (const FaceLoop& face : faces) {
    for (const int v : face) is_corner[static_cast<std::size_t>(v)] = true;
  }
  for (const int index : use) {
    const auto k = static_cast<std::size_t>(index);
    if (is_corner[k]) continue;
    const auto faces_at = std::count_if(faces.begin(), faces.end(), [&](const FaceLoop& face) {
      return plane_of(part_of(face, points), points).height(points.fine(index)) >= -tolerance;
    });
    const char* where = faces_at >= 2 ? "on an edge of" : faces_at == 1 ? "on a face of" : "inside";
    throw NoSolid("vertex " + std::to_string(k) + " is not a corner of the convex hull: it lies " + where +
                      " the hull of the others",
                  NoSolid::Cause::not_a_corner, index);
  }
}

void refuse_large(std::size_t vertices, std::span<const FaceLoop> faces) {
  constexpr auto cause = NoSolid::Cause::too_large;
  if (vertices > ConvexSolid::max_vertices)
    throw NoSolid("the solid has " + std::to_string(vertices) + " vertices, but at most " +
                      std::to_string(ConvexSolid::max_vertices) + " are allowed",
                  cause);
  std::size_t sides = 0;
  for (const FaceLoop& face : faces) sides += face.size();
  if (sides > 2 * std::size_t{ConvexSolid::max_edges})
    throw NoSolid("the solid has " + std::to_string(sides / 2) + " edges and " + std::to_string(faces.size()) +
                      " faces, but at most " + std::to_string(ConvexSolid::max_edges) + " edges and " +
                      std::to_string(ConvexSolid::max_faces) + " faces are allowed",
                  cause);
}

std::vector<FaceLoop> hull_faces(std::span<const Quad3> vertices) {
  const HullPoints points(vertices);
  const auto tolerance = static_cast<double>(rounding_tolerance(vertices) / points.unit());
  refuse_equal_points(points, tolerance);
  std::vector<int> use(vertices.size());
  std::iota(use.begin(), use.end(), 0);
  std::vector<FaceLoop> faces = joined_faces(points, hull_triangles(points, use), tolerance);
  refuse_other_points(points, use, faces, tolerance);
  return faces;
}

}  // namespace isojam
