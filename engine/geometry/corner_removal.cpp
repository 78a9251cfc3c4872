#include "engine/geometry/corner_removal.hpp"

#include <Eigen/Geometry>
#include <cassert>
#include <cmath>
#include <map>
#include <set>
#include <utility>

namespace isojam {

namespace {

/// The convex surface through a closed chain of corners, after the corner in their middle has been removed. All faces
/// at other corners remain faces, so that each new triangle has its corners in the chain. Divides the chain at the
/// triangle over its first and last corner: no other corner of the chain is above this triangle. If several triangles
/// are in one plane, the middle one keeps the number of triangles at each corner small.
template <class Side>
void cover(const Side& side_of, const std::vector<int>& chain, std::vector<HullTriangle>& triangles) {
  if (chain.size() < 3) return;
  const int first = chain.front(), last = chain.back();
  std::vector<std::size_t> best{1};
  for (std::size_t k = 2; k + 1 < chain.size(); ++k) {
    const auto side = side_of(last, first, chain[best.front()], chain[k]);
    if (side > 0) best.clear();
    if (side >= 0) best.push_back(k);
  }
  const auto middle = chain.begin() + static_cast<std::ptrdiff_t>(best[best.size() / 2]);
  triangles.push_back({last, first, *middle});
  cover(side_of, {chain.begin(), middle + 1}, triangles);
  cover(side_of, {middle, chain.end()}, triangles);
}

/// A triangulated hull whose corners can be removed.
class Corners {
 public:
  Corners(const HullPoints& points, const std::vector<HullTriangle>& triangles) : points_(points) {
    for (const HullTriangle& t : triangles) add(t);
  }

  std::size_t size() const { return stars_.size(); }

  void remove_smallest() {
    // One of many neighbours hardly changes a loss, and computing it again for each would take too long.
    constexpr std::size_t many = 32;
    for (const int corner : changed_)
      if (const Star& star = stars_.at(corner); star.loss < 0 || many * star.changes >= star.next.size())
        update(corner);
    changed_.clear();
    while (stars_.at(by_loss_.begin()->second).changes > 0) update(by_loss_.begin()->second);
    const int best = by_loss_.begin()->second;
    by_loss_.erase(by_loss_.begin());
    const std::vector<HullTriangle> patch =
        patch_of(best, [this](int a, int b, int c, int p) { return points_.side(a, b, c, p); });
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
    double loss = -1;         ///< volume that is lost without this corner
    std::size_t changes = 0;  ///< number of triangles that are newer than the loss
  };

  void update(int corner) {
    Star& star = stars_.at(corner);
    by_loss_.erase({star.loss, corner});
    star.loss = loss(corner);
    star.changes = 0;
    by_loss_.insert({star.loss, corner});
  }

  void add(const HullTriangle& t) {
    for (std::size_t k = 0; k < 3; ++k) {
      Star& star = stars_[t[k]];
      star.next[t[(k + 1) % 3]] = t[(k + 2) % 3];
      ++star.changes;
      changed_.insert(t[k]);
    }
  }

  template <class Side>
  std::vector<HullTriangle> patch_of(int corner, const Side& side_of) const {
    const std::map<int, int>& next = stars_.at(corner).next;
    std::vector<int> chain;
    for (int v = next.begin()->first; chain.size() < next.size(); v = next.at(v)) chain.push_back(v);
    std::vector<HullTriangle> patch;
    cover(side_of, chain, patch);
    return patch;
  }

  double loss(int corner) const {
    const auto nearly = [this](int a, int b, int c, int p) {
      constexpr double rounding = 1e-14;  // of a product of three lengths below 1
      const Eigen::Vector3d& o = points_.near(a);
      const double six = (points_.near(b) - o).cross(points_.near(c) - o).dot(points_.near(p) - o);
      return std::abs(six) < rounding ? 0 : six;
    };
    double volume = 0;
    for (const HullTriangle& t : patch_of(corner, nearly)) {
      const Eigen::Vector3d& p = points_.near(corner);
      const Eigen::Vector3d a = points_.near(t[0]) - p, b = points_.near(t[1]) - p, c = points_.near(t[2]) - p;
      volume += std::abs(a.dot(b.cross(c))) / 6;
    }
    return volume;
  }

  const HullPoints& points_;
  std::map<int, Star> stars_;
  std::set<int> changed_;                     ///< corners whose loss may have changed
  std::set<std::pair<double, int>> by_loss_;  ///< the other corners
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
