#include "engine/geometry/repair.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "engine/arithmetic/lanes.hpp"
#include "engine/geometry/corner_removal.hpp"
#include "engine/geometry/hull.hpp"
#include "engine/geometry/planar_faces.hpp"

namespace isojam {
namespace {

using Eigen::Vector3d;

/// Least length of a move that may be allowed, relative to the diameter. Faces that are nearly in one plane are joined
/// within rounding errors, but the corners that they lose may be farther from the edges that remain.
constexpr double rounded_corner = 1e-9;

/// Largest distance of two of the points.
double diameter(const HullPoints& points, const std::vector<int>& use) {
  std::array<std::vector<double>, 3> all;
  for (std::size_t c = 0; c < 3; ++c) {
    for (const int k : use) all[c].push_back(points.near(k)[static_cast<int>(c)]);
    all[c].resize((use.size() + 3) / 4 * 4, all[c].front());
  }
  Lanes largest = Lanes::all(0);
  for (const int k : use) {
    const auto along = [&, p = points.near(k)](int c, std::size_t b) {
      const Lanes length = Lanes::load(&all[static_cast<std::size_t>(c)][b]) - Lanes::all(p[c]);
      return length * length;
    };
    for (std::size_t b = 0; b < all[0].size(); b += 4) largest = max(largest, along(0, b) + along(1, b) + along(2, b));
  }
  return std::sqrt(greatest(largest).first());
}

/// Distance of a point from a convex solid; 0 inside it.
double distance_from(const std::vector<Vector3d>& corners, const std::vector<FaceLoop>& faces, const Vector3d& point) {
  double squared = std::numeric_limits<double>::infinity();
  bool is_outside = false;
  for (const FaceLoop& face : faces) {
    const auto corner = [&](std::size_t k) { return corners[static_cast<std::size_t>(face[k % face.size()])]; };
    Vector3d normal = Vector3d::Zero();
    for (std::size_t k = 1; k + 1 < face.size(); ++k)
      normal += (corner(k) - corner(0)).cross(corner(k + 1) - corner(0));
    normal.normalize();
    const double height = normal.dot(point - corner(0));
    if (height <= 0) continue;
    bool is_above = true;
    for (std::size_t k = 0; k < face.size(); ++k) {
      const Vector3d side = corner(k + 1) - corner(k), from = point - corner(k);
      if (normal.dot(side.cross(from)) >= 0) continue;
      is_above = false;
      const double along = std::clamp(from.dot(side) / side.squaredNorm(), 0.0, 1.0);
      squared = std::min(squared, (from - along * side).squaredNorm());
    }
    if (is_above) squared = std::min(squared, height * height);
    is_outside = true;
  }
  return is_outside ? std::sqrt(squared) : 0;
}

std::string percent(double x) {
  std::array<char, 32> text{};
  return {text.data(),
          std::to_chars(text.data(), text.data() + text.size(), 100 * x, std::chars_format::general, 3).ptr};
}

template <class Loops>
std::vector<int> corners_of(const Loops& faces) {
  std::vector<int> corners;
  for (const auto& face : faces) corners.insert(corners.end(), face.begin(), face.end());
  std::sort(corners.begin(), corners.end());
  corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
  return corners;
}

/// What all repairs of one set of points have in common. Lengths are in units of points.unit().
struct Points {
  explicit Points(std::span<const Vector3d> all)
      : given(all),
        points(widened(all)),
        tolerance(static_cast<double>(rounding_tolerance(widened(all)) / points.unit())) {}

  std::vector<int> every() const {
    std::vector<int> indices(given.size());
    std::iota(indices.begin(), indices.end(), 0);
    return indices;
  }

  /// Finds the hull, once.
  void find_hull() {
    if (!corners.empty()) return;
    triangles = hull_triangles(points, every());
    whole = six_volumes(points, triangles);
    corners = corners_of(triangles);
    if (corners.size() <= std::size_t{most_hull_corners}) diameter = isojam::diameter(points, corners);
  }

  std::span<const Vector3d> given;
  HullPoints points;
  double tolerance, diameter = 0;
  std::vector<HullTriangle> triangles;
  Quad whole = 0;  ///< six times the volume of the hull
  std::vector<int> corners;
};

/// The repair of one set of points. All indices are those of the given points; lengths are in units of points.unit().
class Repair {
 public:
  Repair(Points& all, const RepairOptions& options)
      : all_(all), options_(options), points_(all.points), tolerance_(all.tolerance), use_(all.every()) {}

  RepairedSolid run() {
    const bool welds = options_.merge > 0 || options_.hull;
    if (!welds) refuse_equal_points(points_, tolerance_);
    all_.find_hull();
    std::vector<HullTriangle> triangles = all_.triangles;
    hull_corners_ = all_.corners;
    if (hull_corners_.size() > std::size_t{most_hull_corners})
      throw NoSolid("the convex hull has " + std::to_string(hull_corners_.size()) + " corners, but at most " +
                    std::to_string(most_hull_corners) + " can be repaired");
    diameter_ = all_.diameter;
    merge_ = options_.merge * diameter_;
    if (options_.hull) {
      report_.dropped = static_cast<int>(use_.size() - hull_corners_.size());
      use_ = hull_corners_;
    }
    if (welds && weld(std::max(merge_, tolerance_))) triangles = hull_of_welded();
    std::vector<FaceLoop> faces = joined_faces(points_, triangles, tolerance_);
    expect_corners(faces);
    keep_corners_of(faces);
    if (options_.corners == 0 && merge_ == 0) refuse_large(use_.size(), faces);
    if (report_.dropped > 0) triangles = hull_triangles(points_, use_);
    if (options_.corners > 0) {
      const std::size_t before = use_.size();
      triangles = without_smallest_corners(points_, triangles, options_.corners);
      hull_corners_ = use_ = corners_of(triangles);
      report_.removed_corners = static_cast<int>(before - use_.size());
    }
    if (report_.dropped + report_.removed_corners > 0) faces = joined_faces(points_, triangles, tolerance_);
    join(triangles, std::move(faces));
    const HullPoints result(widened(vertices_));
    const Quad unit = points_.unit(), scale = result.unit() / unit;
    const Quad left = scale * scale * scale * six_volumes(result, hull_faces(widened(vertices_)));
    report_.hull_volume = static_cast<double>(unit * unit * unit * all_.whole / 6);
    report_.volume_change = static_cast<double>(left / all_.whole - 1);
    if (std::abs(report_.volume_change) > options_.max_volume_change)
      throw NoSolid("the repairs change the volume by " + percent(report_.volume_change) + " %, but at most " +
                        percent(options_.max_volume_change) + " % are allowed",
                    NoSolid::Cause::too_coarse);
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

  std::vector<HullTriangle> hull_of_welded() const {
    try {
      return hull_triangles(points_, use_);
    } catch (const NoSolid&) {
      throw NoSolid("welding leaves only " + std::to_string(use_.size()) + " of " + std::to_string(all_.given.size()) +
                        " points, which span no volume",
                    NoSolid::Cause::too_coarse);
    }
  }

  /// Refuses points that are not corners, unless the options allow them.
  void expect_corners(const std::vector<FaceLoop>& faces) {
    if (!options_.hull || options_.measures_depth) {
      const auto [depth, deepest] = largest_depth(faces);
      report_.largest_depth = depth / diameter_;
      // A point so near to a face could be moved to it.
      if (!options_.hull && depth > std::max(merge_, tolerance_))
        refuse_other_points(points_, std::array{deepest}, faces, tolerance_);
    }
    if (!options_.hull && merge_ == 0) refuse_other_points(points_, use_, faces, tolerance_);
  }

  void keep_corners_of(const std::vector<FaceLoop>& faces) {
    std::vector<int> corners = corners_of(faces);
    report_.dropped += static_cast<int>(use_.size() - corners.size());
    use_ = std::move(corners);
  }

  /// Largest distance of a point from the surface of the hull with these faces, and the index of this point.
  std::pair<double, int> largest_depth(const std::vector<FaceLoop>& faces) const {
    std::vector<int> among;
    std::ranges::set_difference(options_.hull ? all_.every() : use_, corners_of(faces), std::back_inserter(among));
    if (among.empty()) return {0, use_.front()};
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
    for (const int k : among) {
      double depth = diameter_;
      for (std::size_t f = 0; f < normals.size() && depth > largest; ++f)
        depth = std::min(depth, offsets[f] - normals[f].dot(points_.near(k)));
      if (depth > largest) largest = depth, deepest = k;
    }
    return {largest, deepest};
  }

  /// Joins faces within the distance that is allowed, and sets the vertices.
  void join(const std::vector<HullTriangle>& triangles, std::vector<FaceLoop> faces) {
    if (merge_ > tolerance_) {
      std::vector<FaceLoop> joined = joined_faces(points_, triangles, merge_);
      report_.joined_faces = static_cast<int>(faces.size()) - static_cast<int>(joined.size());
      faces = std::move(joined);
    }
    keep_corners_of(faces);
    refuse_large(use_.size(), faces);
    for (FaceLoop& face : faces) {
      for (int& v : face) v = static_cast<int>(std::lower_bound(use_.begin(), use_.end(), v) - use_.begin());
    }
    std::vector<Vector3d> corners;
    if (report_.joined_faces > 0) {
      corners = make_planar(faces);
    } else {
      for (const int k : use_) {
        corners.push_back(points_.near(k));
        vertices_.push_back(all_.given[static_cast<std::size_t>(k)]);
      }
    }
    for (const int k : hull_corners_) expect_near(k, distance_from(corners, faces, points_.near(k)));
  }

  void expect_near(int point, double distance) {
    if (distance > (1 + largest_planar_move) * std::max(merge_, rounded_corner * diameter_) + 2 * tolerance_)
      throw NoSolid("the repairs would omit vertex " + std::to_string(point) + ", which is " +
                        percent(distance / diameter_) + " % of the diameter away from the result",
                    NoSolid::Cause::too_coarse, point);
    if (distance > tolerance_) report_.largest_move = std::max(report_.largest_move, distance / diameter_);
  }

  /// Sets the vertices to planar faces, and returns them in scaled coordinates.
  std::vector<Vector3d> make_planar(const std::vector<FaceLoop>& faces) {
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
    std::vector<Vector3d> scaled;
    try {
      const PlanarSolid planar = with_planar_faces(corners, faces, largest_planar_move * merge_);
      for (const Quad3& v : planar.vertices) {
        vertices_.push_back(rounded(points_.unit() * (v - centre)));
        scaled.push_back(rounded(v));
      }
      report_.largest_move += static_cast<double>(planar.largest_move) / diameter_;
    } catch (const NoSolid& error) {
      throw NoSolid(error.what(), error.cause(),
                    error.vertex() < 0 ? -1 : use_[static_cast<std::size_t>(error.vertex())]);
    }
    if (hull_faces(widened(vertices_)) != faces)
      throw NoSolid("the joined faces cannot be written in double precision", NoSolid::Cause::not_planar);
    return scaled;
  }

  Points& all_;
  RepairOptions options_;
  const HullPoints& points_;
  double diameter_ = 0, tolerance_, merge_ = 0;
  std::vector<int> use_;           ///< points that are left, ascending
  std::vector<int> hull_corners_;  ///< corners that must be near the result
  std::vector<Vector3d> vertices_;
  RepairReport report_;
};

/// Looks for changed options with which a repair succeeds that `cause` ended.
struct Trials {
  std::span<const Vector3d> points;
  RepairOptions options;
  NoSolid::Cause cause, refused = NoSolid::Cause::other;
  std::optional<Points> all = {};

  std::optional<RepairOptions> run() {
    if (cause == NoSolid::Cause::equal_points || cause == NoSolid::Cause::not_a_corner) {
      RepairOptions changed = options;
      changed.hull = true;
      if (change(changed)) return changed;
    }
    auto changed = with_smaller_length();
    if (!changed) changed = with_larger_length();
    for (const bool welds : {true, false})
      if (!changed) changed = with_corners(welds);
    if (changed || options.merge == 0 || is_too_large()) return changed;
    options.merge = 0;
    if (change(options)) return options;
    cause = refused;
    return run();
  }

  bool is_too_large() const { return cause == NoSolid::Cause::too_large; }
  bool has_many() const { return points.size() > 1000; }  ///< each try takes long

  std::optional<double> change(RepairOptions changed) {
    changed.measures_depth = false;
    try {
      if (!all) all.emplace(points);
      return std::abs(Repair(*all, changed).run().report.volume_change);
    } catch (const NoSolid& error) {
      refused = error.cause();
      return std::nullopt;
    }
  }

  std::optional<RepairOptions> with_smaller_length() {
    if (options.merge == 0 || (cause != NoSolid::Cause::too_coarse && cause != NoSolid::Cause::not_planar)) return {};
    // With a smaller length, a solid that is already too large remains so.
    constexpr std::array factors{.9,  .7,  .5,  .35,  .25,  .2,  .15,  .12,  .1,   .08,  .06,  .05,
                                 .04, .03, .02, .015, .012, .01, 5e-3, 2e-3, 1e-3, 5e-4, 2e-4, 1e-4};
    RepairOptions changed = options;
    changed.merge = factors.back() * options.merge;
    if (options.corners > 0 && !change(changed)) return {};
    for (std::size_t k = 0; k < factors.size() && refused != NoSolid::Cause::too_large; ++k) {
      changed.merge = factors[k] * options.merge;
      if ((!has_many() || k % 3 == 2) && change(changed)) return changed;
    }
    return {};
  }

  std::optional<RepairOptions> with_larger_length() {
    RepairOptions changed = options;
    changed.merge = largest_merge;
    if (!is_too_large() && options.merge > 0) return {};
    if (is_too_large() && (options.merge >= largest_merge || (!change(changed) && refused == cause))) return {};
    // Smaller lengths leave faces that are almost in one plane. So many points are hardly ever welded below 1e-4.
    for (const double merge : {is_too_large() ? 1e-6 : 1e-9, 1e-5, 1e-4, 1e-3, largest_merge}) {
      changed.merge = merge;
      if (merge > options.merge && (!has_many() || merge >= 1e-4) && change(changed)) return changed;
    }
    return {};
  }

  /// Removing corners from what was welded can fail where it succeeds with all corners.
  std::optional<RepairOptions> with_corners(bool welds) {
    if (cause == NoSolid::Cause::other || (!welds && (options.merge == 0 || !is_too_large()))) return {};
    for (const int corners : {ConvexSolid::max_vertices, 112, 96, 80, ConvexSolid::max_edges / 3 + 2, 0}) {
      if ((corners > 0) != is_too_large() || (corners > 0 && options.corners > 0)) continue;
      if (has_many() && corners > ConvexSolid::max_edges / 3 + 2) continue;
      RepairOptions changed = options;
      if (!welds) changed.merge = 0;
      if (corners > 0) changed.corners = corners;
      changed.max_volume_change = 1;
      const auto volume = change(changed);
      if (!volume) continue;
      const bool is_more = *volume > options.max_volume_change;
      changed.max_volume_change = is_more ? std::ceil(100 * *volume) / 100 : options.max_volume_change;
      return changed;
    }
    return {};
  }
};

}  // namespace

RepairedSolid repaired(std::span<const Vector3d> points, const RepairOptions& options) {
  Points all(points);
  return Repair(all, options).run();
}

std::optional<RepairOptions> tried_repair(std::span<const Vector3d> points, const RepairOptions& options,
                                          NoSolid::Cause cause) {
  return Trials{points, options, cause}.run();
}

}  // namespace isojam
