#pragma once

#include <array>
#include <cstddef>
#include <vector>

namespace isojam::oracle {

/// A convex polyhedron, stored as closed polygons. Half-spaces can be cut off one after another. If T is an exact
/// number type, the result is exact. With T = double, it is accurate enough to construct a test case with a given
/// volume.
template <class T>
class ClipPolytope {
 public:
  using Vector = std::array<T, 3>;

  ClipPolytope(const std::vector<Vector>& vertices, const std::vector<std::vector<int>>& faces) {
    for (const std::vector<int>& face : faces) {
      Polygon& corners = sides_.emplace_back().corners;
      for (const int v : face) corners.push_back(vertices[v]);
    }
  }

  /// Keeps the part with normal·y ≤ offset.
  void clip(const Vector& normal, const T& offset) {
    std::vector<Side> kept;
    std::vector<Segment> rim;
    bool capped = false;  // true if a face lies in the cutting plane, so that the cut is already closed
    for (const Side& side : sides_) {
      const MarkedPolygon cut = clip_polygon(side.corners, normal, offset);
      const std::size_t n = cut.size();
      std::size_t on_plane = 0;
      for (const Marked& corner : cut) on_plane += corner.on_plane;
      if (n >= 3) {
        kept.push_back({{}, side.by_cut});
        for (const Marked& corner : cut) kept.back().corners.push_back(corner.point);
      }
      if (n >= 3 && on_plane == n) {
        capped = true;
        continue;
      }
      if (n < 3) continue;
      for (std::size_t k = 0; k < n; ++k) {
        const Marked &tail = cut[k], &head = cut[(k + 1) % n];
        if (tail.on_plane && head.on_plane) rim.push_back({head.point, tail.point});
      }
    }
    if (!capped) close(kept, rim);
    sides_ = std::move(kept);
  }

  T volume() const {
    T six(0);
    if (sides_.empty()) return six;
    const Vector origin = sides_.front().corners.front();
    for (const Side& side : sides_) {
      const Polygon& polygon = side.corners;
      for (std::size_t k = 1; k + 1 < polygon.size(); ++k) {
        six += determinant(minus(polygon[0], origin), minus(polygon[k], origin), minus(polygon[k + 1], origin));
      }
    }
    return T(six / 6);
  }

  /// The vector area ∫ n dS of the remaining parts of the original faces. n points outwards.
  Vector original_area() const {
    Vector twice{T(0), T(0), T(0)};
    for (const Side& side : sides_) {
      if (side.by_cut) continue;
      const Polygon& polygon = side.corners;
      for (std::size_t k = 1; k + 1 < polygon.size(); ++k) {
        const Vector u = minus(polygon[k], polygon[0]), v = minus(polygon[k + 1], polygon[0]);
        for (std::size_t c = 0; c < 3; ++c) {
          const std::size_t d = (c + 1) % 3, e = (c + 2) % 3;
          twice[c] += T(u[d] * v[e] - u[e] * v[d]);
        }
      }
    }
    return {T(twice[0] / 2), T(twice[1] / 2), T(twice[2] / 2)};
  }

 private:
  using Polygon = std::vector<Vector>;
  struct Side {
    Polygon corners;
    bool by_cut = false;
  };
  struct Marked {
    Vector point;
    bool on_plane;
  };
  using MarkedPolygon = std::vector<Marked>;
  struct Segment {
    Vector tail, head;
  };

  static Vector minus(const Vector& u, const Vector& v) { return {T(u[0] - v[0]), T(u[1] - v[1]), T(u[2] - v[2])}; }

  static T determinant(const Vector& u, const Vector& v, const Vector& w) {
    return T(u[0] * (v[1] * w[2] - v[2] * w[1]) + u[1] * (v[2] * w[0] - v[0] * w[2]) +
             u[2] * (v[0] * w[1] - v[1] * w[0]));
  }

  static T height(const Vector& p, const Vector& normal, const T& offset) {
    return T(normal[0] * p[0] + normal[1] * p[1] + normal[2] * p[2] - offset);
  }

  /// The intersection of an edge with the plane. It is always computed from the end of the edge that remains, so that
  /// both faces of the edge get the same bits.
  static Vector crossing(const Vector& in, const T& below, const Vector& out, const T& above) {
    const T t(below / (below - above));
    return {T(in[0] + t * (out[0] - in[0])), T(in[1] + t * (out[1] - in[1])), T(in[2] + t * (out[2] - in[2]))};
  }

  static MarkedPolygon clip_polygon(const Polygon& polygon, const Vector& normal, const T& offset) {
    std::vector<T> heights;
    for (const Vector& corner : polygon) heights.push_back(height(corner, normal, offset));
    MarkedPolygon cut;
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
  static void close(std::vector<Side>& kept, std::vector<Segment>& rim) {
    if (rim.size() < 3) return;
    Polygon cap;
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
    if (cap.size() >= 3) kept.push_back({std::move(cap), true});
  }

  std::vector<Side> sides_;
};

}  // namespace isojam::oracle
