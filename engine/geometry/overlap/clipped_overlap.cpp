#include <algorithm>
#include <map>
#include <utility>
#include <vector>

#include "engine/geometry/overlap/clipped_overlap.hpp"

// A is cut by the face planes of B one after another. Quadruple precision resolves every pose that doubles can express:
// a vertex is either exactly on a plane, or off it by far more than the rounding error of this arithmetic. A point on a
// plane counts as inside. If a face of A coincides with one of B, it is therefore kept once, as A's.
//
// If a solid is given in double, the vertices of a face lie in one plane only within rounding. A plane almost parallel
// to such a face may cross it more than once, and then no single polygon closes the cut. The code detects such a cut
// and starts again, with a tolerance of that rounding for vertices on a plane.

namespace isojam {

namespace {

struct Plane {
  Quad3 normal;
  Quad offset;
};

using Polygon = QuadIntersection::Polygon;

QuadIntersection whole(const ConvexSolid& a) {
  QuadIntersection solid;
  for (int v = 0; v < a.arrays().vertices; ++v) solid.points.push_back(a.arrays().vertex(v));
  for (std::size_t f = 0; f < a.faces().size(); ++f)
    solid.faces.push_back({a.faces()[f].vertices, static_cast<int>(f), true});
  return solid;
}

/// Face plane of B in A's frame, through the face's first vertex.
Plane placed_plane(const ConvexSolid& b, int face, const QuadPose& pose) {
  const Face& f = b.faces()[static_cast<std::size_t>(face)];
  Plane plane;
  plane.normal = pose.rotation * b.arrays().normal(face);
  plane.offset = dot(plane.normal, pose.rotation * b.arrays().vertex(f.vertices.front()) + pose.displacement);
  return plane;
}

class PlaneCut {
 public:
  PlaneCut(QuadIntersection& solid, const Plane& plane, Quad tolerance) : solid_(solid), tolerance_(tolerance) {
    for (const Quad3& point : solid.points) distance_.push_back(dot(plane.normal, point) - plane.offset);
  }

  /// Cuts, and closes the hole with a polygon on face `face` of B. Returns false if the plane crosses a face more than
  /// once.
  [[nodiscard]] bool apply(int face) {
    std::vector<Polygon> kept;
    for (Polygon& f : solid_.faces) {
      trim(f);
      if (f.loop.size() >= 3) kept.push_back(std::move(f));
    }
    Polygon cap{cap_loop(), face, false};
    if (cap.loop.size() != cap_next_.size()) consistent_ = false;
    if (cap.loop.size() >= 3) kept.push_back(std::move(cap));
    solid_.faces = std::move(kept);
    return consistent_;
  }

 private:
  bool outside(int p) const { return distance_[static_cast<std::size_t>(p)] > tolerance_; }

  /// The point where the edge from a kept vertex to a removed one intersects the plane.
  int crossing(int kept, int cut) {
    const Quad d = distance_[static_cast<std::size_t>(kept)], e = distance_[static_cast<std::size_t>(cut)];
    if (d >= -tolerance_) return kept;
    const auto [slot, is_new] = crossings_.try_emplace({kept, cut}, static_cast<int>(solid_.points.size()));
    if (is_new) {
      const Quad3 p = solid_.points[static_cast<std::size_t>(kept)], q = solid_.points[static_cast<std::size_t>(cut)];
      const Quad s = d / (d - e);
      solid_.points.push_back({p[0] + s * (q[0] - p[0]), p[1] + s * (q[1] - p[1]), p[2] + s * (q[2] - p[2])});
      distance_.push_back(0);
    }
    return slot->second;
  }

  void trim(Polygon& face) {
    std::vector<int> loop;
    int left = -1, entered = -1, departures = 0;
    const auto append = [&loop](int p) {
      if (loop.empty() || loop.back() != p) loop.push_back(p);
    };
    const std::size_t n = face.loop.size();
    for (std::size_t k = 0; k < n; ++k) {
      const int p = face.loop[k], q = face.loop[(k + 1) % n];
      if (!outside(p)) append(p);
      if (!outside(p) && outside(q)) {
        append(left = crossing(p, q));
        ++departures;
      }
      if (outside(p) && !outside(q)) append(entered = crossing(q, p));
    }
    while (loop.size() > 1 && loop.front() == loop.back()) loop.pop_back();
    if (departures > 1) consistent_ = false;
    // The closing polygon contains the same edge in the opposite direction.
    if (left >= 0 && entered >= 0 && left != entered && !cap_next_.emplace(entered, left).second) consistent_ = false;
    face.loop = std::move(loop);
  }

  /// Vertices of the closing polygon; fewer than the number of links if the links do not form one loop.
  std::vector<int> cap_loop() const {
    std::vector<int> loop;
    if (cap_next_.empty()) return loop;
    const int start = cap_next_.begin()->first;
    int p = start;
    do {
      loop.push_back(p);
      const auto next = cap_next_.find(p);
      if (next == cap_next_.end()) break;
      p = next->second;
    } while (p != start && loop.size() <= cap_next_.size());
    return p == start ? loop : std::vector<int>{};
  }

  QuadIntersection& solid_;
  Quad tolerance_;
  std::vector<Quad> distance_;
  std::map<std::pair<int, int>, int> crossings_;
  std::map<int, int> cap_next_;
  bool consistent_ = true;
};

/// Adds V, and S and M as the negative integrals over the faces on B.
void integrate(const QuadIntersection& solid, QuadOverlap& sum) {
  if (solid.faces.empty()) return;
  const Quad3 origin = solid.points[static_cast<std::size_t>(solid.faces.front().loop.front())];
  for (const Polygon& face : solid.faces) {
    const Quad3 p = solid.points[static_cast<std::size_t>(face.loop[0])];
    for (std::size_t k = 1; k + 1 < face.loop.size(); ++k) {
      const Quad3 q = solid.points[static_cast<std::size_t>(face.loop[k])];
      const Quad3 s = solid.points[static_cast<std::size_t>(face.loop[k + 1])];
      const Quad3 twice_area = cross(q - p, s - p);
      sum.volume += dot(p - origin, twice_area) / 6;
      if (face.of_a) continue;
      sum.area = sum.area - Quad(0.5) * twice_area;
      sum.moment = sum.moment - (Quad(1) / 6) * cross(p + q + s, twice_area);
    }
  }
}

FeatureSet edges_between(const ConvexSolid& solid, const std::vector<std::pair<int, int>>& face_pairs) {
  FeatureSet found{};
  for (std::size_t e = 0; e < solid.edges().size(); ++e) {
    const std::pair<int, int> faces{solid.edges()[e].left, solid.edges()[e].right};
    if (std::find(face_pairs.begin(), face_pairs.end(), faces) != face_pairs.end())
      found.insert(static_cast<std::uint32_t>(e));
  }
  return found;
}

void mark_features(const ConvexSolid& a, const ConvexSolid& b, const QuadIntersection& solid, QuadOverlap& result) {
  std::map<std::pair<int, int>, const Polygon*> face_of;
  for (const Polygon& face : solid.faces) {
    (face.of_a ? result.faces_a : result.faces_b).insert(static_cast<std::uint32_t>(face.face));
    for (std::size_t k = 0; k < face.loop.size(); ++k)
      face_of[{face.loop[k], face.loop[(k + 1) % face.loop.size()]}] = &face;
  }
  std::vector<std::pair<int, int>> pairs_a, pairs_b;
  for (const auto& [ends, face] : face_of) {
    const auto back = face_of.find({ends.second, ends.first});
    if (back == face_of.end() || back->second->of_a != face->of_a) continue;
    (face->of_a ? pairs_a : pairs_b).emplace_back(face->face, back->second->face);
  }
  result.edges_a = edges_between(a, pairs_a);
  result.edges_b = edges_between(b, pairs_b);
}

/// The intersection of A and B; returns false if a cut was inconsistent.
bool cut_all(const ConvexSolid& a, const ConvexSolid& b, const QuadPose& pose, Quad tolerance,
             QuadIntersection& solid) {
  solid = whole(a);
  for (int f = 0; f < b.arrays().faces && !solid.faces.empty(); ++f) {
    if (!PlaneCut(solid, placed_plane(b, f, pose), tolerance).apply(f)) return false;
  }
  return true;
}

}  // namespace

QuadIntersection clipped_intersection(const ConvexSolid& a, const ConvexSolid& b, const QuadPose& pose) {
  // This tolerance is between the rounding of quadruple precision (1e-34 of a coordinate) and the smallest distance of
  // planes that do not coincide, which the rounding of doubles determines.
  const Quad exact = Quad(a.circumradius() * std::max(1.0, b.scale() / a.scale())) * Quad(1e-28);
  QuadIntersection solid;
  if (!cut_all(a, b, pose, exact, solid)) {
    // The tolerance grows until all cuts are consistent. The loop ends: when every vertex counts as on every plane,
    // nothing is cut.
    Quad rounding = gap_tolerance(a, b, narrowed(pose));
    while (!cut_all(a, b, pose, rounding, solid)) rounding *= 2;
  }
  return solid;
}

QuadOverlap overlap_of(const ConvexSolid& a, const ConvexSolid& b, const QuadIntersection& intersection) {
  QuadOverlap result;
  integrate(intersection, result);
  if (!(result.volume > 0)) return {};
  mark_features(a, b, intersection, result);
  return result;
}

QuadOverlap clipped_overlap(const ConvexSolid& a, const ConvexSolid& b, const QuadPose& pose) {
  return overlap_of(a, b, clipped_intersection(a, b, pose));
}

Overlap narrowed(const QuadOverlap& exact) {
  Overlap result;
  if (!(exact.volume > 0)) return result;
  result.path = OverlapPath::clip;
  result.volume = static_cast<double>(exact.volume);
  result.area = rounded(exact.area);
  result.moment = rounded(exact.moment);
  result.faces_a = exact.faces_a;
  result.faces_b = exact.faces_b;
  result.edges_a = exact.edges_a;
  result.edges_b = exact.edges_b;
  return result;
}

Overlap clipped_overlap(const ConvexSolid& a, const ConvexSolid& b, const RelativePose& pose) {
  return narrowed(clipped_overlap(a, b, widened(pose)));
}

}  // namespace isojam
