#include "tasks/packings/surface.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "engine/geometry/repair.hpp"

namespace isojam {
namespace {

using Eigen::Vector3d;

/// Tolerance in units of the diameter. Coordinates in files have at least seven digits, and the last digit is rounded.
/// The tolerance is larger than this rounding: the plane through three rounded points deviates more at a distance.
constexpr double digits = 1e-5;

using Loop = std::vector<std::size_t>;

std::string line_text(std::size_t line) { return line == 0 ? std::string() : fmt::format(" (line {})", line); }

double diameter_of(const std::vector<Vector3d>& points) {
  double squared = 0;
  for (std::size_t a = 0; a < points.size(); ++a) {
    for (std::size_t b = 0; b < a; ++b) squared = std::max(squared, (points[a] - points[b]).squaredNorm());
  }
  return std::sqrt(squared);
}

/// The different points that faces use, and for each point of the mesh the index of its own.
struct Distinct {
  std::vector<Vector3d> points;
  std::vector<std::size_t> index;
  int unused = 0;
};

/// False for a face with fewer than three different corners. Some programs write such faces at arbitrary positions.
bool spans_area(const Mesh& mesh, const Mesh::Face& face) {
  std::size_t different = 0;
  for (std::size_t k = 0; k < face.points.size() && different < 3; ++k) {
    const auto end = face.points.begin() + static_cast<std::ptrdiff_t>(k);
    different += std::none_of(face.points.begin(), end,
                              [&](std::size_t p) { return mesh.points[p] == mesh.points[face.points[k]]; });
  }
  return different == 3;
}

/// The points of the faces with an area.
Distinct distinct_points(const Mesh& mesh, std::size_t most) {
  constexpr auto none = static_cast<std::size_t>(-1);
  Distinct distinct;
  distinct.index.assign(mesh.points.size(), none);
  std::map<std::array<double, 3>, std::size_t> known;
  for (const auto& face : mesh.faces) {
    if (!spans_area(mesh, face)) continue;
    for (const auto corner : face.points) {
      if (distinct.index[corner] != none) continue;
      const Vector3d& v = mesh.points[corner];
      // A sum with 0 makes 0 from −0.
      const auto [found, added] = known.try_emplace({v.x() + 0, v.y() + 0, v.z() + 0}, distinct.points.size());
      if (added) distinct.points.push_back(v);
      distinct.index[corner] = found->second;
      if (distinct.points.size() > most)
        throw NoSurface(fmt::format("the surface has more than {} different points", most),
                        "set \"hull\" to true and \"corners\" to 66 to use a part of the convex hull, or simplify the "
                        "surface in the program that made it",
                        face.line);
    }
  }
  distinct.unused = static_cast<int>(std::count(distinct.index.begin(), distinct.index.end(), none));
  return distinct;
}

struct Side {
  std::size_t low, high, face;
  bool forward;  ///< true if the face passes from `low` to `high`

  std::pair<std::size_t, std::size_t> ends() const { return {low, high}; }
};

/// Checks a surface whose points are given in units of its diameter, relative to their mean.
class Checks {
 public:
  Checks(const Mesh& mesh, const Distinct& distinct, double merge)
      : given_(distinct.points), diameter_(diameter_of(given_)) {
    Vector3d centre = Vector3d::Zero();
    for (const Vector3d& v : given_) centre += v / static_cast<double>(given_.size());
    if (!(diameter_ > 0)) throw NoSurface("all vertices are in one place", "", 0);
    welded_ = welded(given_, merge * diameter_);
    for (const Vector3d& v : given_) points_.emplace_back((v - centre) / diameter_);
    tolerance_ = surface_tolerance(merge);
    for (const auto& face : mesh.faces) {
      if (!spans_area(mesh, face)) continue;
      Loop loop;
      for (const auto corner : face.points) {
        const auto point = welded_[distinct.index[corner]];
        if (loop.empty() || loop.back() != point) loop.push_back(point);
      }
      while (loop.size() > 1 && loop.front() == loop.back()) loop.pop_back();
      if (loop.size() < 3) continue;  // a face without area
      loops_.push_back(std::move(loop));
      lines_.push_back(face.line);
    }
    if (loops_.empty()) throw NoSurface("the file contains no faces", "", 0);
  }

  void run() {
    pair_sides();
    orient();
    for (const auto& loop : loops_) normals_.push_back(normal_of(loop));
    refuse_bent_faces();
    for (std::size_t k = 0; k < sides_.size(); k += 2) refuse_dent(sides_[k], sides_[k + 1]);
  }

  double diameter() const { return diameter_; }
  /// The points of the faces that have an area after welding.
  std::vector<Vector3d> points() const {
    std::vector<char> used(given_.size(), 0);
    for (const auto& loop : loops_) {
      for (const auto point : loop) used[point] = 1;
    }
    std::vector<Vector3d> points;
    for (std::size_t k = 0; k < given_.size(); ++k) {
      if (used[welded_[k]]) points.push_back(given_[k]);
    }
    return points;
  }
  double volume() const {
    double six = 0;
    for (const auto& loop : loops_) six += six_volumes(loop);
    return std::abs(six) / 6 * diameter_ * diameter_ * diameter_;
  }
  double area() const {
    double twice = 0;
    for (const auto& loop : loops_) twice += twice_area(loop).norm();
    return twice / 2 * diameter_ * diameter_;
  }

 private:
  std::string edge_text(const Side& side) const {
    return fmt::format("the edge from {} to {}", point_text(given_[side.low]), point_text(given_[side.high]));
  }

  /// Distance from the nearest other end of an open edge: the gap to be closed there.
  double gap_at(const std::vector<std::size_t>& ends, std::size_t point) const {
    double least = 1;
    for (const auto other : ends) {
      if (other != point) least = std::min(least, (points_[point] - points_[other]).norm());
    }
    return least;
  }

  [[noreturn]] void refuse_open(const std::vector<Side>& open) const {
    constexpr std::size_t most_ends = 1000;
    std::vector<std::size_t> ends;
    for (const auto& side : open) ends.insert(ends.end(), {side.low, side.high});
    std::sort(ends.begin(), ends.end());
    ends.erase(std::unique(ends.begin(), ends.end()), ends.end());
    double gap = 0;
    if (ends.size() <= most_ends) {
      for (const auto point : ends) gap = std::max(gap, gap_at(ends, point));
    }
    const auto& first = open.front();
    throw NoSurface(fmt::format("the surface is not closed: {} belongs to only one face{}", edge_text(first),
                                open.size() == 1 ? "" : fmt::format(", and {} other edges too", open.size() - 1)),
                    "add the missing face, or set \"hull\" to true to use the convex hull of the vertices",
                    lines_[first.face], gap);
  }

  /// Sorts the sides of all faces, so that the two sides of an edge follow each other.
  void pair_sides() {
    for (std::size_t f = 0; f < loops_.size(); ++f) {
      const auto& loop = loops_[f];
      for (std::size_t k = 0; k < loop.size(); ++k) {
        const auto a = loop[k], b = loop[(k + 1) % loop.size()];
        sides_.push_back({std::min(a, b), std::max(a, b), f, a < b});
      }
    }
    std::stable_sort(sides_.begin(), sides_.end(), [](const Side& a, const Side& b) { return a.ends() < b.ends(); });
    std::vector<Side> open;
    const Side* crowded = nullptr;
    std::size_t most = 2;
    for (std::size_t k = 0; k < sides_.size();) {
      auto end = k;
      while (end < sides_.size() && sides_[end].ends() == sides_[k].ends()) ++end;
      if (end - k == 1) open.push_back(sides_[k]);
      if (end - k > most) crowded = &sides_[k], most = end - k;
      k = end;
    }
    if (!open.empty()) refuse_open(open);
    if (crowded)
      throw NoSurface(fmt::format("{} belongs to {} faces", edge_text(*crowded), most),
                      "remove faces inside the solid and repeated faces, or set \"hull\" to true",
                      lines_[crowded->face]);
  }

  /// Gives all faces the same orientation. Files often mix both.
  void orient() {
    std::vector<std::vector<std::pair<std::size_t, bool>>> neighbours(loops_.size());
    for (std::size_t k = 0; k < sides_.size(); k += 2) {
      const Side &a = sides_[k], &b = sides_[k + 1];
      neighbours[a.face].emplace_back(b.face, a.forward == b.forward);
      neighbours[b.face].emplace_back(a.face, a.forward == b.forward);
    }
    std::vector<signed char> sign(loops_.size(), 0);
    std::vector<std::size_t> queue{0};
    sign[0] = 1;
    for (std::size_t k = 0; k < queue.size(); ++k) {
      for (const auto& [next, opposite] : neighbours[queue[k]]) {
        const auto expected = static_cast<signed char>(opposite ? -sign[queue[k]] : sign[queue[k]]);
        if (sign[next] == 0) {
          sign[next] = expected;
          queue.push_back(next);
        } else if (sign[next] != expected) {
          throw NoSurface("the surface is one-sided", "set \"hull\" to true to use the convex hull of the vertices",
                          lines_[next]);
        }
      }
    }
    if (queue.size() < loops_.size()) {
      const auto other = static_cast<std::size_t>(std::find(sign.begin(), sign.end(), 0) - sign.begin());
      throw NoSurface("the file contains more than one closed surface", "write each solid to its own file",
                      lines_[other]);
    }
    double six = 0;
    for (std::size_t f = 0; f < loops_.size(); ++f) six += sign[f] * six_volumes(loops_[f]);
    for (std::size_t f = 0; f < loops_.size(); ++f) {
      if ((sign[f] > 0) != (six > 0)) std::reverse(loops_[f].begin(), loops_[f].end());
    }
  }

  double six_volumes(const Loop& loop) const {
    double six = 0;
    for (std::size_t k = 1; k + 1 < loop.size(); ++k)
      six += points_[loop[0]].dot(points_[loop[k]].cross(points_[loop[k + 1]]));
    return six;
  }

  Vector3d twice_area(const Loop& loop) const {
    Vector3d sum = Vector3d::Zero();
    for (std::size_t k = 1; k + 1 < loop.size(); ++k)
      sum += (points_[loop[k]] - points_[loop[0]]).cross(points_[loop[k + 1]] - points_[loop[0]]);
    return sum;
  }

  /// Outward normal; zero for a sliver whose width is below the tolerance, because it does not define its plane.
  Vector3d normal_of(const Loop& loop) const {
    double longest = 0;
    for (std::size_t k = 0; k < loop.size(); ++k)
      longest = std::max(longest, (points_[loop[k]] - points_[loop[(k + 1) % loop.size()]]).norm());
    const Vector3d normal = twice_area(loop);
    return normal.norm() <= tolerance_ * longest ? Vector3d(Vector3d::Zero()) : Vector3d(normal.normalized());
  }

  /// A face with more than three corners.
  void refuse_bent_faces() const {
    for (std::size_t f = 0; f < loops_.size(); ++f) {
      double low = 0, high = 0;
      for (const auto point : loops_[f]) {
        const double height = normals_[f].dot(points_[point] - points_[loops_[f][0]]);
        low = std::min(low, height), high = std::max(high, height);
      }
      if (high - low > 2 * tolerance_)
        throw NoSurface(fmt::format("a face is not planar: its corners deviate by {:.2g} of the diameter", high - low),
                        "write its corners with more digits, split it into triangles, or set \"hull\" to true",
                        lines_[f], high - low);
    }
  }

  /// The normal of the larger face is the more accurate one, so that heights are measured above its plane.
  void refuse_dent(const Side& a, const Side& b) const {
    const bool first = twice_area(loops_[a.face]).norm() >= twice_area(loops_[b.face]).norm();
    const auto own = first ? a.face : b.face, other = first ? b.face : a.face;
    double worst = 0;
    for (const auto point : loops_[other]) worst = std::max(worst, normals_[own].dot(points_[point] - points_[a.low]));
    if (worst > tolerance_)
      throw NoSurface(fmt::format("not convex: the faces at {}{} form a dent of {:.2g} of the diameter", edge_text(a),
                                  line_text(lines_[b.face]), worst),
                      "set \"hull\" to true to use the convex hull of the vertices", lines_[a.face], worst);
  }

  const std::vector<Vector3d>& given_;
  std::vector<Vector3d> points_, normals_;
  double diameter_, tolerance_ = 0;
  std::vector<std::size_t> welded_;  ///< for each point, the index of the point that replaces it
  std::vector<Loop> loops_;
  std::vector<std::size_t> lines_;
  std::vector<Side> sides_;
};

}  // namespace

double surface_tolerance(double merge) { return std::max(digits, 2 * merge); }

Surface points_of(const Mesh& mesh) {
  if (mesh.faces.empty()) return {mesh.points};
  auto distinct = distinct_points(mesh, most_points);
  return {std::move(distinct.points), distinct.unused};
}

Surface closed_surface(const Mesh& mesh, double merge) {
  const auto distinct = distinct_points(mesh, most_surface_points);
  Checks checks(mesh, distinct, merge);
  checks.run();
  return {checks.points(), distinct.unused, checks.diameter(), checks.volume(), checks.area()};
}

}  // namespace isojam
