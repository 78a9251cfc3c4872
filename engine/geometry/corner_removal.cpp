#include "engine/geometry/corner_removal.hpp"

#include <Eigen/Geometry>
#include <cassert>
#include <limits>
#include <map>

namespace isojam {

namespace {

/// The convex surface through a closed chain of corners, after the corner in their middle has been removed. All faces
/// at other corners remain faces, so that each new triangle has its corners in the chain. Divides the chain at the
/// triangle over its first and last corner: no other corner of the chain is above this triangle.
void cover(const HullPoints& points, const std::vector<int>& chain, std::vector<HullTriangle>& triangles) {
  if (chain.size() < 3) return;
  const int first = chain.front(), last = chain.back();
  std::size_t best = 1;
  for (std::size_t k = 2; k + 1 < chain.size(); ++k) {
    if (points.side(last, first, chain[best], chain[k]) > 0) best = k;
  }
  triangles.push_back({last, first, chain[best]});
  const auto middle = chain.begin() + static_cast<std::ptrdiff_t>(best);
  cover(points, {chain.begin(), middle + 1}, triangles);
  cover(points, {middle, chain.end()}, triangles);
}

/// A triangulated hull whose corners can be removed.
class Corners {
 public:
  Corners(const HullPoints& points, const std::vector<HullTriangle>& triangles) : points_(points) {
    for (const HullTriangle& t : triangles) add(t);
  }

  std::size_t size() const { return stars_.size(); }

  void remove_smallest() {
    int best = -1;
    double least = std::numeric_limits<double>::infinity();
    for (auto& [corner, star] : stars_) {
      if (star.loss < 0) star.loss = loss(corner);
      if (star.loss < least) {
        least = star.loss;
        best = corner;
      }
    }
    const std::vector<HullTriangle> patch = patch_of(best);
    for (const auto& [from, to] : std::map<int, int>(stars_.at(best).next)) {
      // The triangle (best, from, to) is also in the stars of its other two corners.
      stars_.at(from).next.erase(to);
      stars_.at(to).next.erase(best);
    }
    stars_.erase(best);
    for (const HullTriangle& t : patch) add(t);
  }

  std::vector<HullTriangle> triangles() const {
    std::vector<HullTriangle> all;
    for (const auto& [corner, star] : stars_) {
      for (const auto& [from, to] : star.next) {
        if (corner < from && corner < to) all.push_back({corner, from, to});
      }
    }
    return all;
  }

 private:
  /// Triangles at a corner: next[b] = c for the triangle (corner, b, c).
  struct Star {
    std::map<int, int> next;
    double loss = -1;  ///< volume that is lost without this corner; negative if it is not known
  };

  void add(const HullTriangle& t) {
    for (std::size_t k = 0; k < 3; ++k) {
      Star& star = stars_[t[k]];
      star.next[t[(k + 1) % 3]] = t[(k + 2) % 3];
      star.loss = -1;
    }
  }

  std::vector<HullTriangle> patch_of(int corner) const {
    const std::map<int, int>& next = stars_.at(corner).next;
    std::vector<int> chain;
    for (int v = next.begin()->first; chain.size() < next.size(); v = next.at(v)) chain.push_back(v);
    std::vector<HullTriangle> patch;
    cover(points_, chain, patch);
    return patch;
  }

  double loss(int corner) const {
    double volume = 0;
    for (const HullTriangle& t : patch_of(corner)) {
      const Eigen::Vector3d& p = points_.near(corner);
      const Eigen::Vector3d a = points_.near(t[0]) - p, b = points_.near(t[1]) - p, c = points_.near(t[2]) - p;
      volume += std::abs(a.dot(b.cross(c))) / 6;
    }
    return volume;
  }

  const HullPoints& points_;
  std::map<int, Star> stars_;
};

}  // namespace

std::vector<HullTriangle> without_smallest_corners(const HullPoints& points, const std::vector<HullTriangle>& triangles,
                                                   int corners) {
  assert(corners >= 4);
  Corners hull(points, triangles);
  if (hull.size() <= static_cast<std::size_t>(corners)) return triangles;
  while (hull.size() > static_cast<std::size_t>(corners)) hull.remove_smallest();
  return hull.triangles();
}

}  // namespace isojam
