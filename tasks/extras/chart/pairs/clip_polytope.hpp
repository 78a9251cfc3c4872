#pragma once

#include <array>
#include <cstddef>
#include <utility>
#include <vector>

namespace isojam {

/// The points y with normal·y ≤ offset. The normal may have any length.
template <class T>
struct HalfSpace {
  std::array<T, 3> normal;
  T offset;
};

/// A convex polyhedron, stored as closed polygons. Half-spaces are cut off one after another. If T is an exact number
/// type, the result is exact.
template <class T>
class ClipPolytope {
 public:
  using Vector = std::array<T, 3>;
  static constexpr int none = -1;

  struct Side {
    std::vector<Vector> corners;  ///< counter-clockwise seen from outside
    int face = none;              ///< number of the side
  };

  /// The polyhedron with these sides.
  explicit ClipPolytope(std::vector<Side> sides) : sides_(std::move(sides)) {}

  /// Keeps the part inside the half-space, and gives the new side this number. A side that lies in the plane keeps its
  /// number.
  void clip(const HalfSpace<T>& half_space, int face) {
    std::vector<Side> kept;
    std::vector<Segment> rim;
    bool capped = false;  // true if a face lies in the cutting plane, so that the cut is already closed
    for (Side& side : sides_) {
      std::vector<Marked> cut = cut_of(side.corners, half_space);
      const std::size_t n = cut.size();
      if (n < 3) continue;
      std::size_t on_plane = 0;
      for (const Marked& corner : cut) on_plane += corner.on_plane;
      if (on_plane == n) capped = true;
      for (std::size_t k = 0; k < n && on_plane < n; ++k) {
        const Marked &tail = cut[k], &head = cut[(k + 1) % n];
        if (tail.on_plane && head.on_plane) rim.push_back({head.point, tail.point});
      }
      side.corners.clear();
      for (Marked& corner : cut) side.corners.push_back(std::move(corner.point));
      kept.push_back(std::move(side));
    }
    if (!capped) close(kept, rim, face);
    sides_ = std::move(kept);
  }

  const std::vector<Side>& sides() const { return sides_; }

  /// The same polyhedron in numbers of another type. Sums over it are fast in numbers of 50 digits, whose errors do not
  /// matter once all cuts were exact.
  template <class U>
  ClipPolytope<U> rounded() const {
    std::vector<typename ClipPolytope<U>::Side> sides;
    for (const Side& side : sides_) {
      sides.push_back({{}, side.face});
      for (const Vector& p : side.corners) sides.back().corners.push_back({U(p[0]), U(p[1]), U(p[2])});
    }
    return ClipPolytope<U>(std::move(sides));
  }

  T volume() const {
    T six(0);
    for_each_triangle([&](const Side&, const Vector& p, const Vector& q, const Vector& r) {
      const Vector& origin = sides_.front().corners.front();
      six += dot(minus(p, origin), cross(minus(q, origin), minus(r, origin)));
    });
    return T(six / 6);
  }

  /// The vector area ∫ n dS and the moment ∫ y×n dS of the sides with the numbers 0 … faces − 1. n points outwards.
  std::pair<Vector, Vector> area_and_moment(int faces) const {
    std::pair<Vector, Vector> sums{Vector{T(0), T(0), T(0)}, Vector{T(0), T(0), T(0)}};
    for_each_triangle([&](const Side& side, const Vector& p, const Vector& q, const Vector& r) {
      if (side.face == none || side.face >= faces) return;
      const Vector twice = cross(minus(q, p), minus(r, p));
      const Vector turn = cross({T(p[0] + q[0] + r[0]), T(p[1] + q[1] + r[1]), T(p[2] + q[2] + r[2])}, twice);
      for (std::size_t c = 0; c < 3; ++c) sums.first[c] += twice[c] / 2, sums.second[c] += turn[c] / 6;
    });
    return sums;
  }

  /// Calls visit(side, p, q, r) for the triangles of a fan in every side.
  template <class Visit>
  void for_each_triangle(const Visit& visit) const {
    for (const Side& side : sides_) {
      for (std::size_t k = 1; k + 1 < side.corners.size(); ++k)
        visit(side, side.corners[0], side.corners[k], side.corners[k + 1]);
    }
  }

 private:
  struct Marked {
    Vector point;
    bool on_plane;
  };
  struct Segment {
    Vector tail, head;
  };

  static Vector minus(const Vector& u, const Vector& v) { return {T(u[0] - v[0]), T(u[1] - v[1]), T(u[2] - v[2])}; }
  static T dot(const Vector& u, const Vector& v) { return T(u[0] * v[0] + u[1] * v[1] + u[2] * v[2]); }
  static Vector cross(const Vector& u, const Vector& v) {
    return {T(u[1] * v[2] - u[2] * v[1]), T(u[2] * v[0] - u[0] * v[2]), T(u[0] * v[1] - u[1] * v[0])};
  }

  /// The intersection of an edge with the plane. It is always computed from the end of the edge that remains, so that
  /// both faces of the edge get the same bits.
  static Vector crossing(const Vector& in, const T& below, const Vector& out, const T& above) {
    const T t(below / (below - above));
    return {T(in[0] + t * (out[0] - in[0])), T(in[1] + t * (out[1] - in[1])), T(in[2] + t * (out[2] - in[2]))};
  }

  static std::vector<Marked> cut_of(const std::vector<Vector>& polygon, const HalfSpace<T>& half_space) {
    std::vector<T> heights;
    for (const Vector& corner : polygon) heights.push_back(T(dot(half_space.normal, corner) - half_space.offset));
    std::vector<Marked> cut;
    for (std::size_t k = 0; k < polygon.size(); ++k) {
      const std::size_t next = (k + 1) % polygon.size();
      const T &here = heights[k], &there = heights[next];
      if (here <= 0) cut.push_back({polygon[k], here == 0});
      if (here < 0 && there > 0) cut.push_back({crossing(polygon[k], here, polygon[next], there), true});
      if (here > 0 && there < 0) cut.push_back({crossing(polygon[next], there, polygon[k], here), true});
    }
    return cut;
  }

  /// Joins the edges of the cut to a polygon in the cutting plane.
  static void close(std::vector<Side>& kept, std::vector<Segment>& rim, int face) {
    if (rim.size() < 3) return;
    std::vector<Vector> cap;
    Vector reached = rim.front().tail;
    while (!rim.empty()) {
      std::size_t k = 0;
      while (k < rim.size() && rim[k].tail != reached) ++k;
      if (k == rim.size()) break;
      cap.push_back(rim[k].tail);
      reached = rim[k].head;
      rim[k] = rim.back();
      rim.pop_back();
    }
    if (cap.size() >= 3) kept.push_back({std::move(cap), face});
  }

  std::vector<Side> sides_;
};

}  // namespace isojam
