#include "engine/geometry/contact_loop.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

// Phase 1 tabulates the signed distances of either solid's vertices from the other's planes. Phase 2 sees nothing but
// this table: every edge of one solid is clipped by the planes of the other. Where it enters or leaves it pierces a
// face, and there the loop passes from one of the edge's two faces to the other: one segment of the loop ends and the
// next begins. Segments are identified by their pair of faces, so the loop closes if and only if every pair that
// begins also ends, once. No segment is ever found by intersecting two planes, which is ill-conditioned when they
// are nearly parallel.

namespace isojam {

namespace {

constexpr int capacity = SolidArrays::capacity;

/// The segments that meet where an edge pierces a face: face pairs, capacity·i + j.
struct Piercing {
  std::uint16_t begins, ends;
  std::uint8_t corner;
};

struct Piercings {
  std::array<Piercing, ContactLoop::max_corners> at;
  int count = 0;
};

int padded(int n) { return (n + 3) & ~3; }

/// `shift` is the position of `body`'s centre seen from that of `other`.
void measure(const PlacedSolid& body, const PlacedSolid& other, const Eigen::Vector3d& shift, Distances& d) {
  const int planes = padded(other.faces());
  const double *nx = other.nx(), *ny = other.ny(), *nz = other.nz(), *offset = other.offset();
  alignas(32) double constant[capacity];
  for (int f = 0; f < planes; ++f) constant[f] = nx[f] * shift.x() + ny[f] * shift.y() + nz[f] * shift.z() - offset[f];
  for (int v = 0; v < body.vertices(); ++v) {
    const double x = body.x()[v], y = body.y()[v], z = body.z()[v];
    for (int f = 0; f < planes; ++f) d.of[v][f] = nx[f] * x + ny[f] * y + nz[f] * z + constant[f];
  }
}

void classify(int vertices, int planes, double tolerance, Distances& d) {
  for (int v = 0; v < vertices; ++v) {
    std::uint32_t outside = 0, uncertain = 0;
    for (int f = 0; f < planes; ++f) {
      outside |= std::uint32_t{d.of[v][f] > 0} << f;
      uncertain |= std::uint32_t{std::abs(d.of[v][f]) < tolerance} << f;
    }
    d.outside[v] = outside;
    d.uncertain[v] = uncertain;
  }
}

/// Signed distance of a vertex from a plane in two doubles: n·(y + shift) − offset, with products of high parts exact
/// and low parts to first order.
double precise_distance(const PlacedSolid& body, int vertex, const PlacedSolid& other, int plane,
                        const TwoDoubleVector& shift) {
  const TwoDoubleVector n = other.precise_normal(plane), y = body.precise_vertex(vertex);
  TwoDouble sum = -other.precise_offset(plane);
  for (int c = 0; c < 3; ++c) {
    const TwoDouble p = two_sum(y.high[c], shift.high[c]);
    const TwoDouble product = two_product(n.high[c], p.high);
    const TwoDouble next = two_sum(sum.high, product.high);
    const double first_order = n.high[c] * (p.low + y.low[c] + shift.low[c]) + n.low[c] * p.high;
    sum = {next.high, sum.low + (next.low + product.low + first_order)};
  }
  return sum.high + sum.low;
}

/// Takes the distances marked uncertain again in two doubles, and leaves those marked that are zero to their rounding.
void refine(const PlacedSolid& body, const PlacedSolid& other, const TwoDoubleVector& shift, double tolerance,
            Distances& d) {
  for (int v = 0; v < body.vertices(); ++v) {
    std::uint32_t still = 0;
    for (std::uint32_t near = d.uncertain[v]; near; near &= near - 1) {
      const int f = std::countr_zero(near);
      const double distance = precise_distance(body, v, other, f, shift);
      d.of[v][f] = distance;
      d.outside[v] = (d.outside[v] & ~(std::uint32_t{1} << f)) | std::uint32_t{distance > 0} << f;
      still |= std::uint32_t{std::abs(distance) < tolerance} << f;
    }
    d.uncertain[v] = still;
  }
}

/// Planes with every vertex outside: each separates.
std::uint32_t separating_planes(const Distances& d, int vertices) {
  std::uint32_t all = ~std::uint32_t{0};
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
  std::uint32_t tail = d.outside[edge.tail], head = d.outside[edge.head];
  if (tail & head) return false;
  for (; tail; tail &= tail - 1) {
    const int f = std::countr_zero(tail);
    const double s = d.of[edge.tail][f] / (d.of[edge.tail][f] - d.of[edge.head][f]);
    if (inside.enter_plane < 0 || s > inside.enter) inside.enter = s, inside.enter_plane = f;
  }
  for (; head; head &= head - 1) {
    const int f = std::countr_zero(head);
    const double s = d.of[edge.tail][f] / (d.of[edge.tail][f] - d.of[edge.head][f]);
    if (inside.leave_plane < 0 || s < inside.leave) inside.leave = s, inside.leave_plane = f;
  }
  return inside.enter < inside.leave;
}

/// Where an edge pierces `plane`, or its own vertex if plane < 0.
Corner corner_at(const PlacedSolid& body, const Distances& d, const Edge& edge, int plane, bool leaving, bool of_a) {
  Corner corner{};
  corner.tail = static_cast<std::uint8_t>(edge.tail), corner.head = static_cast<std::uint8_t>(edge.head);
  corner.plane = static_cast<std::int8_t>(plane);
  corner.of_a = of_a;
  corner.weight_tail = leaving ? 0 : 1, corner.weight_head = leaving ? 1 : 0;
  if (plane >= 0) {
    const double tail = d.of[edge.tail][plane], head = d.of[edge.head][plane], all = tail - head;
    corner.weight_tail = -head / all, corner.weight_head = tail / all;
  }
  corner.position = corner.weight_tail * body.vertex(edge.tail) + corner.weight_head * body.vertex(edge.head);
  return corner;
}

std::uint16_t face_pair(int face_a, int face_b) { return static_cast<std::uint16_t>(capacity * face_a + face_b); }

/// The loop turns the same way round on both surfaces, so seen from outside B it runs clockwise: beginnings and
/// ends are exchanged.
Piercing pierce(int corner, const Edge& edge, int plane, bool leaving, bool of_a) {
  const int first = leaving ? edge.left : edge.right;
  const int second = leaving ? edge.right : edge.left;
  const auto at = static_cast<std::uint8_t>(corner);
  if (of_a) return {face_pair(first, plane), face_pair(second, plane), at};
  return {face_pair(plane, second), face_pair(plane, first), at};
}

/// `shift`: where the solid's centre is, from that of A.
void clip_edges(const PlacedSolid& body, const Eigen::Vector3d& shift, const Distances& d, bool of_a, ContactLoop& loop,
                Piercings& piercings) {
  const SolidArrays& solid = body.solid().arrays();
  std::uint32_t& edges_inside = of_a ? loop.edges_a : loop.edges_b;
  const int first_face = of_a ? 0 : face_of_b;
  for (int e = 0; e < solid.edges; ++e) {
    const Edge& edge = solid.edge[e];
    Interval inside;
    if (!clip_edge(d, edge, inside)) continue;
    edges_inside |= std::uint32_t{1} << e;
    const int from = 2 * loop.spans, to = from + 1;
    loop.corner[from] = corner_at(body, d, edge, inside.enter_plane, false, of_a);
    loop.corner[to] = corner_at(body, d, edge, inside.leave_plane, true, of_a);
    loop.corner[from].position += shift;
    loop.corner[to].position += shift;
    loop.span[loop.spans++] = {static_cast<std::uint8_t>(from), static_cast<std::uint8_t>(to),
                               static_cast<std::uint8_t>(first_face + edge.left),
                               static_cast<std::uint8_t>(first_face + edge.right)};
    if (inside.enter_plane >= 0) piercings.at[piercings.count++] = pierce(from, edge, inside.enter_plane, false, of_a);
    if (inside.leave_plane >= 0) piercings.at[piercings.count++] = pierce(to, edge, inside.leave_plane, true, of_a);
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
    const Piercing& end = piercings.at[k];
    std::uint8_t& slot = beginning[end.ends];
    if (slot == 0) return false;
    loop.segment[loop.segments++] = {piercings.at[slot - 1].corner, end.corner,
                                     static_cast<std::uint8_t>(end.ends / capacity),
                                     static_cast<std::uint8_t>(face_of_b + end.ends % capacity)};
    slot = 0;
  }
  return true;
}

/// By value: the origin is itself one of the corners.
void move_origin(Eigen::Vector3d origin, ContactLoop& loop) {
  loop.origin = origin;
  for (int k = 0; k < 2 * loop.spans; ++k) loop.corner[k].position -= origin;
}

bool separated_by_face(const Distances& vertices_of_a, int a, const Distances& vertices_of_b, int b,
                       SeparatingAxis& axis) {
  if (const std::uint32_t planes = separating_planes(vertices_of_a, a); planes != 0) {
    axis = {SeparatingAxis::Kind::face_b, 0, static_cast<std::uint8_t>(std::countr_zero(planes))};
    return true;
  }
  if (const std::uint32_t planes = separating_planes(vertices_of_b, b); planes != 0) {
    axis = {SeparatingAxis::Kind::face_a, static_cast<std::uint8_t>(std::countr_zero(planes)), 0};
    return true;
  }
  return false;
}

/// Phase 1; entries smaller than `near` are marked uncertain.
void tabulate(const PlacedSolid& a, const PlacedSolid& b, const Eigen::Vector3d& r, double near, ContactLoop& loop) {
  measure(a, b, -r, loop.of_a);
  measure(b, a, r, loop.of_b);
  classify(a.vertices(), b.faces(), near, loop.of_a);
  classify(b.vertices(), a.faces(), near, loop.of_b);
}

/// Phase 2.
void trace(const PlacedSolid& a, const PlacedSolid& b, const Eigen::Vector3d& r, ContactLoop& loop) {
  loop.verdict = LoopVerdict::separated;
  loop.axis = {};
  loop.spans = loop.segments = 0;
  loop.edges_a = loop.edges_b = 0;
  if (separated_by_face(loop.of_a, a.vertices(), loop.of_b, b.vertices(), loop.axis)) return;

  loop.verdict = LoopVerdict::degenerate;
  if (has_vertex_on_plane(loop.of_a, a.vertices()) || has_vertex_on_plane(loop.of_b, b.vertices())) return;
  Piercings piercings;
  clip_edges(a, Eigen::Vector3d::Zero(), loop.of_a, true, loop, piercings);
  clip_edges(b, r, loop.of_b, false, loop, piercings);
  if (piercings.count == 0) {
    // No edge pierces a face: the solids are apart, or one holds the other and all its edges lie inside.
    if (loop.spans == 0) loop.verdict = LoopVerdict::separated;
    return;
  }
  if (!close_loop(piercings, loop)) return;
  move_origin(loop.corner[piercings.at[0].corner].position, loop);
  loop.verdict = LoopVerdict::closed;
}

}  // namespace

void find_contact_loop(const PlacedSolid& a, const PlacedSolid& b, const Eigen::Vector3d& r, ContactLoop& loop) {
  tabulate(a, b, r, gap_tolerance(a.solid(), b.solid(), r), loop);
  trace(a, b, r, loop);
}

double refined_below(const ConvexSolid& a, const ConvexSolid& b) { return 2e-3 * std::min(a.inradius(), b.inradius()); }

void find_contact_loop(const PlacedSolid& a, const PlacedSolid& b, const TwoDoubleVector& r, ContactLoop& loop) {
  const double tolerance = std::numeric_limits<double>::epsilon() * gap_tolerance(a.solid(), b.solid(), r.high);
  tabulate(a, b, r.high, refined_below(a.solid(), b.solid()), loop);
  refine(a, b, -r, tolerance, loop.of_a);
  refine(b, a, r, tolerance, loop.of_b);
  trace(a, b, r.high, loop);
}

}  // namespace isojam
