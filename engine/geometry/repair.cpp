#include "engine/geometry/repair.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <utility>

#include "engine/geometry/corner_removal.hpp"
#include "engine/geometry/hull.hpp"
#include "engine/geometry/planar_faces.hpp"

namespace isojam {

namespace {

using Eigen::Vector3d;

double diameter(const HullPoints& points) {
  double largest = 0;
  for (int a = 0; a < points.size(); ++a) {
    for (int b = 0; b < a; ++b) largest = std::max(largest, (points.near(a) - points.near(b)).squaredNorm());
  }
  return std::sqrt(largest);
}

template <class Loops>
std::vector<int> corners_of(const Loops& faces) {
  std::vector<int> corners;
  for (const auto& face : faces) corners.insert(corners.end(), face.begin(), face.end());
  std::sort(corners.begin(), corners.end());
  corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
  return corners;
}

/// The repair of one set of points. All indices are those of the given points; lengths are in units of points.unit().
class Repair {
 public:
  Repair(std::span<const Vector3d> given, const RepairOptions& options)
      : given_(given),
        options_(options),
        points_(widened(given)),
        diameter_(diameter(points_)),
        tolerance_(static_cast<double>(rounding_tolerance(widened(given)) / points_.unit())),
        merge_(options.merge * diameter_),
        use_(given.size()) {
    std::iota(use_.begin(), use_.end(), 0);
  }

  RepairedSolid run() {
    const bool welds = merge_ > 0 || options_.hull;
    if (!welds) refuse_equal_points(points_, tolerance_);
    std::vector<HullTriangle> triangles = hull_triangles(points_, use_);
    const Quad whole = six_volumes(points_, triangles);
    if (welds && weld(std::max(merge_, tolerance_))) triangles = hull_triangles(points_, use_);
    const std::vector<FaceLoop> faces = joined_faces(points_, triangles, tolerance_);
    const auto [depth, deepest] = largest_depth(faces);
    report_.largest_depth = depth / diameter_;
    // A point so near to a face could be moved to it.
    if (!options_.hull && depth > std::max(merge_, tolerance_))
      refuse_other_points(points_, std::array{deepest}, faces, tolerance_);
    if (!options_.hull && merge_ == 0) refuse_other_points(points_, use_, faces, tolerance_);
    keep_corners_of(faces);
    triangles = hull_triangles(points_, use_);
    if (options_.corners > 0) {
      const std::size_t before = use_.size();
      triangles = without_smallest_corners(points_, triangles, options_.corners);
      use_ = corners_of(triangles);
      report_.removed_corners = static_cast<int>(before - use_.size());
    }
    join(triangles);
    const HullPoints result(widened(vertices_));
    const Quad unit = points_.unit(), scale = result.unit() / unit;
    const Quad left = scale * scale * scale * six_volumes(result, hull_faces(widened(vertices_)));
    report_.hull_volume = static_cast<double>(unit * unit * unit * whole / 6);
    report_.volume_change = static_cast<double>(left / whole - 1);
    return {std::move(vertices_), report_};
  }

 private:
  /// Keeps the first of all points that are nearer to each other than `distance`. Returns true if points were omitted.
  bool weld(double distance) {
    std::vector<Vector3d> all;
    for (const int k : use_) all.push_back(points_.near(k));
    const std::vector<std::size_t> first = welded(all, distance);
    std::vector<int> kept;
    for (std::size_t k = 0; k < all.size(); ++k) {
      if (first[k] == k) kept.push_back(use_[k]);
      report_.largest_move = std::max(report_.largest_move, (all[k] - all[first[k]]).norm() / diameter_);
    }
    report_.welded = static_cast<int>(use_.size() - kept.size());
    use_ = std::move(kept);
    return report_.welded > 0;
  }

  void keep_corners_of(const std::vector<FaceLoop>& faces) {
    std::vector<int> corners = corners_of(faces);
    report_.dropped += static_cast<int>(use_.size() - corners.size());
    use_ = std::move(corners);
  }

  /// Largest distance of a point from the surface of the hull with these faces, and the index of this point.
  std::pair<double, int> largest_depth(const std::vector<FaceLoop>& faces) const {
    std::vector<Quad3> all;
    for (int k = 0; k < points_.size(); ++k) all.push_back(points_[k]);
    std::vector<Vector3d> normals;
    std::vector<double> offsets;
    for (const FaceLoop& face : faces) {
      const FacePlane plane = fitted_plane(face, all);
      normals.push_back(rounded(plane.normal));
      offsets.push_back(static_cast<double>(plane.offset));
    }
    double largest = 0;
    int deepest = use_.front();
    for (const int k : use_) {
      double depth = diameter_;
      for (std::size_t f = 0; f < normals.size() && depth > largest; ++f)
        depth = std::min(depth, offsets[f] - normals[f].dot(points_.near(k)));
      if (depth > largest) largest = depth, deepest = k;
    }
    return {largest, deepest};
  }

  /// Joins faces within the distance that is allowed, and sets the vertices.
  void join(const std::vector<HullTriangle>& triangles) {
    std::vector<FaceLoop> faces = joined_faces(points_, triangles, tolerance_);
    if (merge_ > tolerance_) {
      std::vector<FaceLoop> joined = joined_faces(points_, triangles, merge_);
      report_.joined_faces = static_cast<int>(faces.size()) - static_cast<int>(joined.size());
      faces = std::move(joined);
    }
    keep_corners_of(faces);
    refuse_large(use_.size(), faces);
    if (report_.joined_faces > 0) return make_planar(std::move(faces));
    for (const int k : use_) vertices_.push_back(given_[static_cast<std::size_t>(k)]);
  }

  void make_planar(std::vector<FaceLoop> faces) {
    for (FaceLoop& face : faces) {
      for (int& v : face) v = static_cast<int>(std::lower_bound(use_.begin(), use_.end(), v) - use_.begin());
    }
    std::vector<Quad3> corners;
    Quad3 low = points_[use_.front()], high = low;
    for (const int k : use_) {
      corners.push_back(points_[k]);
      for (std::size_t c = 0; c < 3; ++c) {
        low[c] = std::min(low[c], points_[k][c]);
        high[c] = std::max(high[c], points_[k][c]);
      }
    }
    const Quad3 centre = (Quad(1) / 2) * (low + high);
    try {
      const PlanarSolid planar = with_planar_faces(corners, faces, largest_planar_move * merge_);
      for (const Quad3& v : planar.vertices) vertices_.push_back(rounded(points_.unit() * (v - centre)));
      report_.largest_move += static_cast<double>(planar.largest_move) / diameter_;
    } catch (const NoSolid& error) {
      throw NoSolid(error.what(), error.cause(),
                    error.vertex() < 0 ? -1 : use_[static_cast<std::size_t>(error.vertex())]);
    }
    if (hull_faces(widened(vertices_)) != faces)
      throw NoSolid("the joined faces cannot be written in double precision", NoSolid::Cause::not_planar);
  }

  std::span<const Vector3d> given_;
  RepairOptions options_;
  HullPoints points_;
  double diameter_, tolerance_, merge_;
  std::vector<int> use_;  ///< points that are left, ascending
  std::vector<Vector3d> vertices_;
  RepairReport report_;
};

}  // namespace

std::vector<std::size_t> welded(std::span<const Vector3d> points, double distance) {
  std::vector<std::size_t> parent(points.size()), order(points.size());
  std::iota(parent.begin(), parent.end(), std::size_t{0});
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto root = [&](std::size_t k) {
    while (parent[k] != k) k = parent[k] = parent[parent[k]];
    return k;
  };
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return points[a].x() < points[b].x(); });
  for (std::size_t k = 0; k < order.size(); ++k) {
    for (std::size_t l = k + 1; l < order.size(); ++l) {
      const Vector3d &p = points[order[k]], &q = points[order[l]];
      if (q.x() - p.x() > distance) break;
      if ((p - q).norm() > distance) continue;
      const std::size_t a = root(order[k]), b = root(order[l]);
      parent[std::max(a, b)] = std::min(a, b);
    }
  }
  for (std::size_t k = 0; k < parent.size(); ++k) parent[k] = root(k);
  return parent;
}

RepairedSolid repaired(std::span<const Vector3d> points, const RepairOptions& options) {
  return Repair(points, options).run();
}

}  // namespace isojam
