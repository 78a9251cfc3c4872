#include "engine/geometry/contact_loop.hpp"

#include <bit>
#include <cmath>
#include <limits>

#include "engine/geometry/lanes.hpp"

// Phase 1 (distances.cpp) tabulates the signed distances of either solid's vertices from the other's planes. Phase 2,
// here, sees nothing but this table: every edge of one solid is clipped by the planes of the other. Where it enters or
// leaves it pierces a face, and there the loop passes from one of the edge's two faces to the other: one segment of the
// loop ends and the next begins. Segments are identified by their pair of faces, so the loop closes if and only if
// every pair that begins also ends, once. No segment is ever found by intersecting two planes, which is ill-conditioned
// when they are nearly parallel.
//
// Contacts are so small that mispredicted branches would cost more than the arithmetic: what differs from pair to pair
// is chosen by masks and selection, and only the lengths of loops remain unpredictable. Each loop does one thing, so
// that several of its steps are in flight at once.

namespace isojam {

namespace {

constexpr int capacity = SolidArrays::capacity;

/// A vertex on a plane, to within rounding, and not certainly outside of another one.
bool has_vertex_on_plane(const Distances& d, double tolerance) {
  for (std::uint32_t rows = d.rows; rows; rows &= rows - 1) {
    const double* row = d.row(std::countr_zero(rows));
    bool on = false, outside = false;
    for (int f = 0; f < d.planes; ++f) {
      on |= std::abs(row[f]) < tolerance;
      outside |= row[f] >= tolerance;
    }
    if (on && !outside) return true;
  }
  return false;
}

/// One solid's part in the loop.
struct Side {
  Lanes shift;  ///< the solid's centre from that of A; height 0
  const EdgeRecord* edge;
  const double* distance;  ///< the table
  const PlacedSolid* body;
  const double* height;  ///< of the solid's vertices over the reference plane,
  int height_stride;
  std::uint32_t reference;  ///< column of the reference plane; `none` if it is one of the solid's own
};
constexpr std::uint32_t none = 2 * capacity;

constexpr double at_tail = 0;
constexpr double at_head = 1 + 64 * std::numeric_limits<double>::epsilon();  // past every tagged parameter

/// Where an edge enters and leaves the other solid, in every lane: the parameter (0 at the tail, 1 at the head), tagged
/// by the plane.
struct Interval {
  Lanes enter, leave;
};

template <class Count>
Interval clip(Count vectors, const double* tail, const double* head) {
  const Lanes start = Lanes::all(at_tail), end = Lanes::all(at_head);
  Lanes enter = start, leave = end;
  for (int k = 0; k < vectors; ++k) {
    const Lanes t = Lanes::load(tail + 4 * k), h = Lanes::load(head + 4 * k);
    const Lanes crossing = tagged(t / (t - h), 4 * k);
    enter = max(enter, where_negative(t, start, crossing));
    leave = min(leave, where_negative(h, end, crossing));
  }
  return {greatest(enter), least(leave)};
}

/// An edge that passes through the other solid: bit 0..31 for those of A, 32.. of B; the planes where it enters and
/// leaves, and bits of `ends` that say whether it does: 0 and 1 for entering, 2 and 3 for leaving.
struct Crossing {
  std::uint32_t bit, into, out_of, ends;
};

/// `alive`: edges of A, and from bit 32 on of B. Returns the number of crossings then.
template <class Count>
int find_crossings(Count vectors, const Side* sides, std::uint64_t alive, Crossing* crossing, int count) {
  const Lanes untouched = Lanes::of(at_tail, at_tail, at_head, at_head);
  for (; alive; alive &= alive - 1) {
    const auto bit = static_cast<std::uint32_t>(std::countr_zero(alive));
    const Side& side = sides[bit / 32];
    const EdgeRecord& edge = side.edge[bit % 32];
    const Interval inside =
        clip(vectors, side.distance + 4 * vectors * edge.tail, side.distance + 4 * vectors * edge.head);
    crossing[count] = {bit, tag_of(inside.enter.first()), tag_of(inside.leave.first()),
                       ~sign_bits(equal(halves(inside.enter, inside.leave), untouched))};
    count += inside.enter.first() < inside.leave.first();
  }
  return count;
}

struct Masks {
  /// Negative where an end of an edge is its own vertex, by bit 0: it enters, bit 1: it leaves.
  alignas(32) double own_end[4][4] = {{-1, -1, -1, -1}, {1, 1, -1, -1}, {-1, -1, 1, 1}, {1, 1, 1, 1}};
  alignas(32) double whole[4] = {0, -1, -1, 0};
  /// 0 in place of a height that is 0 by construction.
  alignas(32) double height[2][4] = {{1, 1, 1, 1}, {1, 1, 1, 0}};
};
constexpr Masks masks;

/// The two corners of an edge that passes through the other solid.
void place_corners(const Side& side, int planes, const Crossing& c, double (*corner)[4]) {
  const EdgeRecord& edge = side.edge[c.bit % 32];
  const double *tail = side.distance + planes * edge.tail, *head = side.distance + planes * edge.head;
  const std::uint32_t enters = c.ends & 1, leaves = c.ends >> 3 & 1;
  // Weights of tail and head at either end: products of distances, each right to its own last bits however small.
  const Lanes pierced = Lanes::of(tail[c.into], head[c.into], tail[c.out_of], head[c.out_of]);
  const Lanes d = where_negative(Lanes::load(masks.own_end[enters + 2 * leaves]), Lanes::load(masks.whole), pierced);
  const Lanes exchanged = swapped_pairs(d), weight = exchanged / (exchanged - d);
  const auto vertex = [&](int v) {
    return with_fourth(Lanes::load(side.body->row(v)) + side.shift, side.height[side.height_stride * v]);
  };
  const Lanes p = vertex(edge.tail), q = vertex(edge.head);
  const Lanes from = fma(p, lane<0>(weight), q * lane<1>(weight)), to = fma(p, lane<2>(weight), q * lane<3>(weight));
  (from * Lanes::load(masks.height[enters & std::uint32_t{c.into == side.reference}])).store(corner[0]);
  (to * Lanes::load(masks.height[leaves & std::uint32_t{c.out_of == side.reference}])).store(corner[1]);
}

/// Where an edge pierces a face: the pair of faces whose segment begins there, and the pair whose segment ends.
struct Piercings {
  std::uint32_t pairs[ContactLoop::max_corners + 1];  ///< begins + 2^16·ends
  std::uint32_t corner[ContactLoop::max_corners + 1];
  int count = 0;

  void add(std::uint32_t begins_and_ends, int at, std::uint32_t real) {
    pairs[count] = begins_and_ends;
    corner[count] = static_cast<std::uint32_t>(at);
    count += static_cast<int>(real);
  }
};

/// Joins every end to the beginning of the same face pair. False if the loop does not close.
bool close_loop(const Piercings& piercings, int faces_a, ContactLoop& loop) {
  alignas(32) std::uint8_t beginning[capacity * capacity];  // corner + 1; 0: none
  static_assert(capacity == 4 * sizeof(double));
  for (int f = 0; f < faces_a; ++f) Lanes::all(0).store(reinterpret_cast<double*>(beginning + capacity * f));
  for (int k = 0; k < piercings.count; ++k)
    beginning[piercings.pairs[k] & 0xFFFF] = static_cast<std::uint8_t>(piercings.corner[k] + 1);
  bool open = false;
  for (int k = 0; k < piercings.count; ++k) {
    const std::uint32_t pair = piercings.pairs[k] >> 16;
    const std::uint32_t from = beginning[pair];
    beginning[pair] = 0;
    open |= from == 0;
    loop.segment[k] = {static_cast<std::uint16_t>((from - 1) % ContactLoop::max_corners),
                       static_cast<std::uint16_t>(piercings.corner[k]), static_cast<std::uint16_t>(pair / capacity),
                       static_cast<std::uint16_t>(face_of_b + pair % capacity)};
  }
  loop.segments = piercings.count;
  return !open;
}

/// Chooses the plane that heights are measured from: the one penetrated least.
void choose_reference(const PlacedSolid& a, const PlacedSolid& b, ContactLoop& loop, Side* sides) {
  const Distances &of_a = loop.of_a, &of_b = loop.of_b;
  // Either way is as likely: indices instead of branches.
  const int over_b = of_a.least_penetration < of_b.least_penetration;
  const int plane_a = of_b.least_penetrated, plane_b = of_a.least_penetrated;
  const double* height_a[2] = {a.solid().arrays().height[plane_a], of_a.of + plane_b};
  const double* height_b[2] = {of_b.of + plane_a, b.solid().arrays().height[plane_b]};
  const int stride_a[2] = {1, of_a.planes}, stride_b[2] = {of_b.planes, 1};
  const std::uint32_t column_a[2] = {none, static_cast<std::uint32_t>(plane_b)};
  const std::uint32_t column_b[2] = {static_cast<std::uint32_t>(plane_a), none};
  const int face[2] = {plane_a, face_of_b + plane_b};
  loop.reference = face[over_b];
  sides[0].height = height_a[over_b], sides[0].height_stride = stride_a[over_b], sides[0].reference = column_a[over_b];
  sides[1].height = height_b[over_b], sides[1].height_stride = stride_b[over_b], sides[1].reference = column_b[over_b];
}

/// Clips the edges of both solids and closes the loop.
template <class CountsA, class CountsB>
void trace(const CountsA& counts_a, const CountsB& counts_b, const PlacedSolid& a, const PlacedSolid& b,
           const Eigen::Vector3d& r, ContactLoop& loop) {
  const SolidArrays &solid_a = a.solid().arrays(), &solid_b = b.solid().arrays();
  Side sides[2] = {{Lanes::all(0), solid_a.record, loop.of_a.of, &a, nullptr, 0, none},
                   {Lanes::of(r.x(), r.y(), r.z(), 0), solid_b.record, loop.of_b.of, &b, nullptr, 0, none}};
  choose_reference(a, b, loop, sides);
  Crossing crossing[ContactLoop::max_spans + 1];
  const std::uint64_t alive_a = loop.of_a.edges, alive_b = std::uint64_t{loop.of_b.edges} << 32;
  int spans = 0, spans_a = 0;
  if constexpr (std::is_same_v<CountsA, AnyCounts>) {
    spans_a = find_crossings(counts_a.vectors, sides, alive_a, crossing, 0);
    spans = find_crossings(counts_b.vectors, sides, alive_b, crossing, spans_a);
  } else {
    // One loop for both, so that its end is mispredicted once.
    spans = find_crossings(counts_a.vectors, sides, alive_a | alive_b, crossing, 0);
  }
  Piercings piercings;
  std::uint64_t kept = 0;
  for (int k = 0; k < spans; ++k) {
    const Crossing& c = crossing[k];
    const std::uint32_t of_b = c.bit / 32;
    kept |= std::uint64_t{1} << c.bit;
    place_corners(sides[of_b], 4 * (of_b ? counts_b : counts_a).vectors, c, loop.corner + 2 * k);
    const EdgeRecord& edge = sides[of_b].edge[c.bit % 32];
    const std::uint32_t leaving = edge.pairs[of_b], step = std::uint32_t{0x00010001} << 5 * of_b;
    loop.span[k] = static_cast<std::uint16_t>(edge.sides + 0x0101 * face_of_b * of_b);
    piercings.add(std::rotl(leaving, 16) + step * c.into, 2 * k, c.ends & 1);
    piercings.add(leaving + step * c.out_of, 2 * k + 1, c.ends >> 3 & 1);
  }
  loop.spans = spans;
  loop.edges_a = static_cast<std::uint32_t>(kept), loop.edges_b = static_cast<std::uint32_t>(kept >> 32);
  if (piercings.count == 0) {
    // No edge pierces a face: the solids are apart, or one holds the other and all its edges lie inside.
    loop.verdict = spans == 0 ? LoopVerdict::separated : LoopVerdict::degenerate;
  } else {
    loop.verdict = close_loop(piercings, solid_a.faces, loop) ? LoopVerdict::closed : LoopVerdict::degenerate;
  }
}

/// Whether a face separates; it becomes the loop's axis if it does so beyond the rows of the table and rounding.
bool separated_by_face(const PlacedSolid& a, const PlacedSolid& b, const Eigen::Vector3d& r, ContactLoop& loop) {
  using Kind = SeparatingAxis::Kind;
  SeparatingAxis axis;
  if (loop.of_a.least_penetration <= 0) {
    axis = {Kind::face_b, 0, static_cast<std::uint8_t>(loop.of_a.least_penetrated)};
  } else if (loop.of_b.least_penetration <= 0) {
    axis = {Kind::face_a, static_cast<std::uint8_t>(loop.of_b.least_penetrated), 0};
  } else {
    return false;
  }
  if (separates(a, b, r, axis)) loop.axis = axis;
  return true;
}

}  // namespace

void find_contact_loop(const PlacedSolid& a, const PlacedSolid& b, const Eigen::Vector3d& r, ContactLoop& loop) {
  loop.axis = {};
  loop.spans = loop.segments = 0;
  measure(a, b, r, loop.of_a);
  measure(b, a, -r, loop.of_b);
  loop.verdict = LoopVerdict::separated;
  if (separated_by_face(a, b, r, loop)) return;
  loop.verdict = LoopVerdict::degenerate;
  const double tolerance = gap_tolerance(a.solid(), b.solid(), r);
  if (loop.of_a.nearest < tolerance && has_vertex_on_plane(loop.of_a, tolerance)) return;
  if (loop.of_b.nearest < tolerance && has_vertex_on_plane(loop.of_b, tolerance)) return;
  const SolidArrays &solid_a = a.solid().arrays(), &solid_b = b.solid().arrays();
  if (solid_a.vertices == solid_b.vertices && solid_a.faces == solid_b.faces) {
    with_counts(solid_a, solid_b.faces, [&](const auto& counts) { trace(counts, counts, a, b, r, loop); });
  } else {
    trace(AnyCounts{solid_a.vertices, (solid_b.faces + 3) / 4, solid_a.edges},
          AnyCounts{solid_b.vertices, (solid_a.faces + 3) / 4, solid_b.edges}, a, b, r, loop);
  }
}

}  // namespace isojam
