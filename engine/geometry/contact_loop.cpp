#include "engine/geometry/contact_loop.hpp"

#include <bit>
#include <cmath>

// Every edge of one solid is clipped by the planes of the other. Where it enters or leaves it pierces a face, and
// there the loop passes from one of the edge's two faces to the other: one segment of the loop ends and the next
// begins. Segments are identified by their pair of faces, so the loop closes if and only if every pair that
// begins also ends, once. No segment is ever found by intersecting two planes, which is ill-conditioned when they
// are nearly parallel.

namespace isojam {

namespace {

constexpr int capacity = SolidArrays::capacity;

/// Signed distances of the vertices of one solid from the planes of the other: distance[plane][vertex].
struct Distances {
  alignas(32) double of[capacity][capacity];
  alignas(32) std::uint64_t outside[capacity] = {};    ///< per vertex, planes it lies outside of
  alignas(32) std::uint64_t uncertain[capacity] = {};  ///< per vertex, planes it lies on to within rounding
};

/// Where an edge enters or leaves the other solid, and the two loop segments that meet there.
struct Piercing {
  Eigen::Vector3d point;
  std::uint16_t begins, ends;  ///< face pairs, capacity·i + j
};

struct Piercings {
  std::array<Piercing, 2 * ContactLoop::max_spans> at;
  int count = 0;
};

int padded(int n) { return (n + 3) & ~3; }

void place(const SolidArrays& solid, const RelativePose& pose, PlacedSolid& placed) {
  const auto& r = pose.rotation;
  const auto& t = pose.displacement;
  const double r00 = r(0, 0), r01 = r(0, 1), r02 = r(0, 2);
  const double r10 = r(1, 0), r11 = r(1, 1), r12 = r(1, 2);
  const double r20 = r(2, 0), r21 = r(2, 1), r22 = r(2, 2);
  const double tx = t.x(), ty = t.y(), tz = t.z();
  for (int k = 0; k < padded(solid.vertices); ++k) {
    placed.x[k] = r00 * solid.x[k] + r01 * solid.y[k] + r02 * solid.z[k] + tx;
    placed.y[k] = r10 * solid.x[k] + r11 * solid.y[k] + r12 * solid.z[k] + ty;
    placed.z[k] = r20 * solid.x[k] + r21 * solid.y[k] + r22 * solid.z[k] + tz;
  }
  for (int k = 0; k < padded(solid.faces); ++k) {
    placed.nx[k] = r00 * solid.nx[k] + r01 * solid.ny[k] + r02 * solid.nz[k];
    placed.ny[k] = r10 * solid.nx[k] + r11 * solid.ny[k] + r12 * solid.nz[k];
    placed.nz[k] = r20 * solid.nx[k] + r21 * solid.ny[k] + r22 * solid.nz[k];
    placed.offset[k] = solid.offset[k] + placed.nx[k] * tx + placed.ny[k] * ty + placed.nz[k] * tz;
  }
}

template <class Vertices, class Planes>
void measure(const Vertices& body, int vertices, const Planes& other, int planes, double tolerance, Distances& d) {
  const int n = padded(vertices);
  for (int f = 0; f < planes; ++f) {
    const double nx = other.nx[f], ny = other.ny[f], nz = other.nz[f], offset = other.offset[f];
    const std::uint64_t bit = std::uint64_t{1} << f;
    for (int v = 0; v < n; ++v) {
      const double distance = nx * body.x[v] + ny * body.y[v] + nz * body.z[v] - offset;
      d.of[f][v] = distance;
      d.outside[v] |= distance > 0 ? bit : 0;
      d.uncertain[v] |= std::abs(distance) < tolerance ? bit : 0;
    }
  }
}

/// Planes with every vertex outside: each separates.
std::uint64_t separating_planes(const Distances& d, int vertices) {
  std::uint64_t all = ~std::uint64_t{0};
  for (int v = 0; v < vertices; ++v) all &= d.outside[v];
  return all;
}

/// A vertex on a plane, to within rounding, and not certainly outside of another one.
bool has_vertex_on_plane(const Distances& d, int vertices) {
  for (int v = 0; v < vertices; ++v) {
    if (d.uncertain[v] != 0 && (d.outside[v] & ~d.uncertain[v]) == 0) return true;
  }
  return false;
}

/// The interval [enter, leave] of an edge (parameter 0 at the tail, 1 at the head) inside the other solid.
struct Interval {
  double enter = 0, leave = 1;
  int enter_plane = -1, leave_plane = -1;
};

/// False if the edge lies outside.
bool clip_edge(const Distances& d, const Edge& edge, Interval& inside) {
  std::uint64_t tail = d.outside[edge.tail], head = d.outside[edge.head];
  if (tail & head) return false;
  for (; tail; tail &= tail - 1) {
    const int f = std::countr_zero(tail);
    const double s = d.of[f][edge.tail] / (d.of[f][edge.tail] - d.of[f][edge.head]);
    if (inside.enter_plane < 0 || s > inside.enter) inside.enter = s, inside.enter_plane = f;
  }
  for (; head; head &= head - 1) {
    const int f = std::countr_zero(head);
    const double s = d.of[f][edge.tail] / (d.of[f][edge.tail] - d.of[f][edge.head]);
    if (inside.leave_plane < 0 || s < inside.leave) inside.leave = s, inside.leave_plane = f;
  }
  return inside.enter < inside.leave;
}

std::uint16_t face_pair(int face_a, int face_b) { return static_cast<std::uint16_t>(capacity * face_a + face_b); }

/// The loop turns the same way round on both surfaces, so seen from outside B it runs clockwise: beginnings and
/// ends are exchanged.
Piercing pierce(const Eigen::Vector3d& point, const Edge& edge, int plane, bool leaving, bool of_a) {
  const int first = leaving ? edge.left : edge.right;
  const int second = leaving ? edge.right : edge.left;
  if (of_a) return {point, face_pair(first, plane), face_pair(second, plane)};
  return {point, face_pair(plane, second), face_pair(plane, first)};
}

template <class Body>
void clip_edges(const Body& body, const SolidArrays& solid, const Distances& d, bool of_a, ContactLoop& loop,
                Piercings& piercings) {
  std::uint32_t& edges_inside = of_a ? loop.edges_a : loop.edges_b;
  for (int e = 0; e < solid.edges; ++e) {
    const Edge& edge = solid.edge[e];
    Interval inside;
    if (!clip_edge(d, edge, inside)) continue;
    edges_inside |= std::uint32_t{1} << e;
    const Eigen::Vector3d tail(body.x[edge.tail], body.y[edge.tail], body.z[edge.tail]);
    const Eigen::Vector3d head(body.x[edge.head], body.y[edge.head], body.z[edge.head]);
    EdgeSpan& span = loop.span[loop.spans++];
    span.from = tail, span.to = head;
    span.left = static_cast<std::uint8_t>(edge.left), span.right = static_cast<std::uint8_t>(edge.right);
    span.of_a = of_a;
    if (inside.enter_plane >= 0) {
      span.from = tail + inside.enter * (head - tail);
      piercings.at[piercings.count++] = pierce(span.from, edge, inside.enter_plane, false, of_a);
    }
    if (inside.leave_plane >= 0) {
      span.to = tail + inside.leave * (head - tail);
      piercings.at[piercings.count++] = pierce(span.to, edge, inside.leave_plane, true, of_a);
    }
  }
}

/// Joins every beginning to the end of the same face pair. False if the loop does not close.
bool close_loop(const Piercings& piercings, ContactLoop& loop) {
  std::array<std::uint8_t, capacity * capacity> beginning{};  // piercing + 1; 0: none
  for (int k = 0; k < piercings.count; ++k) {
    std::uint8_t& slot = beginning[piercings.at[k].begins];
    if (slot != 0) return false;
    slot = static_cast<std::uint8_t>(k + 1);
  }
  for (int k = 0; k < piercings.count; ++k) {
    std::uint8_t& slot = beginning[piercings.at[k].ends];
    if (slot == 0) return false;
    LoopSegment& segment = loop.segment[loop.segments++];
    segment.from = piercings.at[slot - 1].point;
    segment.to = piercings.at[k].point;
    segment.face_a = static_cast<std::uint8_t>(piercings.at[k].ends / capacity);
    segment.face_b = static_cast<std::uint8_t>(piercings.at[k].ends % capacity);
    slot = 0;
  }
  return true;
}

void move_origin(const Eigen::Vector3d& origin, ContactLoop& loop) {
  loop.origin = origin;
  for (int k = 0; k < loop.spans; ++k) loop.span[k].from -= origin, loop.span[k].to -= origin;
  for (int k = 0; k < loop.segments; ++k) loop.segment[k].from -= origin, loop.segment[k].to -= origin;
}

bool separated_by_face(const Distances& vertices_of_a, int a, const Distances& vertices_of_b, int b,
                       SeparatingAxis& axis) {
  if (const std::uint64_t planes = separating_planes(vertices_of_a, a); planes != 0) {
    axis = {SeparatingAxis::Kind::face_b, 0, static_cast<std::uint8_t>(std::countr_zero(planes))};
    return true;
  }
  if (const std::uint64_t planes = separating_planes(vertices_of_b, b); planes != 0) {
    axis = {SeparatingAxis::Kind::face_a, static_cast<std::uint8_t>(std::countr_zero(planes)), 0};
    return true;
  }
  return false;
}

}  // namespace

void find_contact_loop(const ConvexSolid& a, const ConvexSolid& b, const RelativePose& pose, ContactLoop& loop) {
  loop.verdict = LoopVerdict::separated;
  loop.axis = {};
  loop.spans = loop.segments = 0;
  loop.edges_a = loop.edges_b = 0;
  const SolidArrays& solid_a = a.arrays();
  const SolidArrays& solid_b = b.arrays();
  const double tolerance = gap_tolerance(a, b, pose);

  place(solid_b, pose, loop.b);
  Distances of_a, of_b;
  measure(solid_a, solid_a.vertices, loop.b, solid_b.faces, tolerance, of_a);
  measure(loop.b, solid_b.vertices, solid_a, solid_a.faces, tolerance, of_b);
  if (separated_by_face(of_a, solid_a.vertices, of_b, solid_b.vertices, loop.axis)) return;

  loop.verdict = LoopVerdict::degenerate;
  if (has_vertex_on_plane(of_a, solid_a.vertices) || has_vertex_on_plane(of_b, solid_b.vertices)) return;
  Piercings piercings;
  clip_edges(solid_a, solid_a, of_a, true, loop, piercings);
  clip_edges(loop.b, solid_b, of_b, false, loop, piercings);
  if (piercings.count == 0) {
    // No edge pierces a face: the solids are apart, or one holds the other and all its edges lie inside.
    if (loop.spans == 0) loop.verdict = LoopVerdict::separated;
    return;
  }
  if (!close_loop(piercings, loop)) return;
  move_origin(piercings.at[0].point, loop);
  loop.verdict = LoopVerdict::closed;
}

}  // namespace isojam
