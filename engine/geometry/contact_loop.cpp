#include "engine/geometry/contact_loop.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

// Phase 1 (distances.cpp) tabulates the signed distances of either solid's vertices from the other's planes. Phase 2,
// here, sees nothing but this table: every edge of one solid is clipped by the planes of the other. Where it enters or
// leaves it pierces a face, and there the loop passes from one of the edge's two faces to the other: one segment of the
// loop ends and the next begins. Segments are identified by their pair of faces, so the loop closes if and only if
// every pair that begins also ends, once. No segment is ever found by intersecting two planes, which is ill-conditioned
// when they are nearly parallel.

namespace isojam {

namespace {

constexpr int capacity = SolidArrays::capacity;
constexpr std::uint32_t face_pairs = capacity * capacity;
constexpr std::uint32_t none = 2 * capacity;

/// Edges of all pairs: 32·solid + edge.
struct EdgeList {
  std::uint32_t at[ContactLoops::max_pairs * capacity + capacity];
  int count = 0;

  void add(std::uint32_t first, std::uint32_t edges) {
    constexpr int usual = 6;  // written without asking how many there are
    std::uint32_t* end = at + count;
    count += std::popcount(edges);
    for (int k = 0; k < usual; ++k, edges &= edges - 1)
      end[k] = first + static_cast<std::uint32_t>(std::countr_zero(edges));
    for (end += usual; edges; edges &= edges - 1) *end++ = first + static_cast<std::uint32_t>(std::countr_zero(edges));
  }
};

/// A vertex on a plane, to within rounding, and not certainly outside of another one.
bool has_vertex_on_plane(const Distances& d, double tolerance) {
  if (d.nearest >= tolerance) return false;
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

/// The axis of the face that separates, if it does so beyond the rows of the table and rounding.
SeparatingAxis separating_face(const PlacedPair& pair, const Distances& of_a, const Distances& of_b) {
  using Kind = SeparatingAxis::Kind;
  SeparatingAxis axis{Kind::face_a, static_cast<std::uint8_t>(of_b.least_penetrated), 0};
  if (of_a.least_penetration <= 0) axis = {Kind::face_b, 0, static_cast<std::uint8_t>(of_a.least_penetrated)};
  return separates(*pair.a, *pair.b, pair.r, axis) ? axis : SeparatingAxis{};
}

/// Chooses the plane that heights are measured from: the one penetrated least.
void set_sides(const PlacedPair& pair, int p, ContactLoops& loops) {
  const Distances &of_a = loops.distances[2 * p], &of_b = loops.distances[2 * p + 1];
  const SolidArrays &a = pair.a->solid().arrays(), &b = pair.b->solid().arrays();
  const int plane_a = of_b.least_penetrated, plane_b = of_a.least_penetrated;
  // Either way is as likely: indices instead of branches.
  const int over_b = of_a.least_penetration < of_b.least_penetration;
  const double* height_a[2] = {a.height[plane_a], of_a.of + plane_b};
  const double* height_b[2] = {of_b.of + plane_a, b.height[plane_b]};
  const auto planes_a = static_cast<std::uint32_t>(of_a.planes), planes_b = static_cast<std::uint32_t>(of_b.planes);
  const std::uint32_t stride_a[2] = {1, planes_a}, stride_b[2] = {planes_b, 1};
  const std::uint32_t column_a[2] = {none, static_cast<std::uint32_t>(plane_b)};
  const std::uint32_t column_b[2] = {static_cast<std::uint32_t>(plane_a), none};
  const PlacedSolid* solid[2] = {pair.a, pair.b};
  const int plane[2] = {plane_a, plane_b};
  const std::uint32_t first_pair = face_pairs * 0x00010001 * static_cast<std::uint32_t>(p);
  const Lanes half = Lanes::of(pair.r.x() / 2, pair.r.y() / 2, pair.r.z() / 2, 0);
  loops.up[p] = solid[over_b]->normal(plane[over_b]);
  loops.side[2 * p] = {a.record,         pair.a,           of_a.of,    height_a[over_b],    planes_a,
                       stride_a[over_b], column_a[over_b], first_pair, Lanes::all(0) - half};
  loops.side[2 * p + 1] = {b.record,         pair.b,     of_b.of, height_b[over_b], planes_b, stride_b[over_b],
                           column_b[over_b], first_pair, half};
}

/// Phase 1 of pair p. Unless a face separates, its edges join the lists.
void begin(const PlacedPair& pair, int p, ContactLoops& loops, EdgeList& of_a, EdgeList& of_b) {
  Distances &distances_a = loops.distances[2 * p], &distances_b = loops.distances[2 * p + 1];
  measure(*pair.a, *pair.b, pair.r, distances_a);
  measure(*pair.b, *pair.a, -pair.r, distances_b);
  loops.faces[2 * p] = loops.faces[2 * p + 1] = loops.edges[2 * p] = loops.edges[2 * p + 1] = 0;
  loops.axis[p] = {};
  if (std::min(distances_a.least_penetration, distances_b.least_penetration) <= 0) {
    loops.verdict[p] = LoopVerdict::separated;
    loops.axis[p] = separating_face(pair, distances_a, distances_b);
    return;
  }
  const double tolerance = gap_tolerance(pair.a->solid(), pair.b->solid(), pair.r);
  if (has_vertex_on_plane(distances_a, tolerance) || has_vertex_on_plane(distances_b, tolerance)) {
    loops.verdict[p] = LoopVerdict::degenerate;
    return;
  }
  loops.verdict[p] = LoopVerdict::closed;
  set_sides(pair, p, loops);
  of_a.add(static_cast<std::uint32_t>(capacity * 2 * p), distances_a.edges);
  of_b.add(static_cast<std::uint32_t>(capacity * (2 * p + 1)), distances_b.edges);
}

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
  repeat(vectors, [&](int k) {
    const Lanes t = Lanes::load(tail + 4 * k), h = Lanes::load(head + 4 * k);
    const Lanes crossing = tagged(t / (t - h), 4 * k);
    enter = max(enter, where_negative(t, start, crossing));
    leave = min(leave, where_negative(h, end, crossing));
  });
  return {greatest(enter), least(leave)};
}

/// An edge that passes through the other solid: as in EdgeList; the planes where it enters and leaves; and bits of
/// `ends` that say whether it does: 0 and 1 for entering, 2 and 3 for leaving.
struct Crossing {
  std::uint32_t edge, into, out_of, ends;
};

/// Returns the number of crossings found so far.
int find_crossings(const ContactLoops& loops, int planes, const EdgeList& edges, Crossing* crossing, int count) {
  with_vectors((planes + 3) / 4, [&](auto vectors) {
    const Lanes untouched = Lanes::of(at_tail, at_tail, at_head, at_head);
    for (int k = 0; k < edges.count; ++k) {
      const std::uint32_t at = edges.at[k];
      const ContactLoops::Side& side = loops.side[at / capacity];
      const EdgeRecord& edge = side.edge[at % capacity];
      const Interval inside =
          clip(vectors, side.distance + 4 * vectors * edge.tail, side.distance + 4 * vectors * edge.head);
      crossing[count] = {at, tag_of(inside.enter.first()), tag_of(inside.leave.first()),
                         ~sign_bits(equal(halves(inside.enter, inside.leave), untouched))};
      count += inside.enter.first() < inside.leave.first();
    }
  });
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
inline void place_corners(const ContactLoops::Side& side, const EdgeRecord& edge, const Crossing& c,
                          double (*corner)[4]) {
  const double *tail = side.distance + side.planes * edge.tail, *head = side.distance + side.planes * edge.head;
  const std::uint32_t enters = c.ends & 1, leaves = c.ends >> 3 & 1;
  // Weights of tail and head at either end: products of distances, each right to its own last bits however small.
  const Lanes pierced = Lanes::of(tail[c.into], head[c.into], tail[c.out_of], head[c.out_of]);
  const Lanes d = where_negative(Lanes::load(masks.own_end[enters + 2 * leaves]), Lanes::load(masks.whole), pierced);
  const Lanes exchanged = swapped_pairs(d), weight = exchanged / (exchanged - d);
  const Lanes p =
      with_fourth(Lanes::load(side.body->row(edge.tail)) + side.shift, side.height[side.stride * edge.tail]);
  const Lanes q =
      with_fourth(Lanes::load(side.body->row(edge.head)) + side.shift, side.height[side.stride * edge.head]);
  const Lanes from = fma(p, lane<0>(weight), q * lane<1>(weight)), to = fma(p, lane<2>(weight), q * lane<3>(weight));
  (from * Lanes::load(masks.height[enters & std::uint32_t{c.into == side.reference}])).store(corner[0]);
  (to * Lanes::load(masks.height[leaves & std::uint32_t{c.out_of == side.reference}])).store(corner[1]);
}

/// Where an edge pierces a face: the faces whose segment begins there, and those whose segment ends.
struct Piercings {
  std::uint32_t pairs[2 * ContactLoops::max_spans + 1];  ///< begins + 2^16·ends
  std::uint32_t corner[2 * ContactLoops::max_spans + 1];
  int count = 0;

  void add(std::uint32_t begins_and_ends, int at, std::uint32_t real) {
    pairs[count] = begins_and_ends;
    corner[count] = static_cast<std::uint32_t>(at);
    count += static_cast<int>(real);
  }
};

void place_spans(const Crossing* crossing, ContactLoops& loops, Piercings& piercings) {
  for (int k = 0; k < loops.spans; ++k) {
    const Crossing c = crossing[k];
    const std::uint32_t solid = c.edge / capacity, of_b = solid % 2, e = c.edge % capacity;
    const ContactLoops::Side& side = loops.side[solid];
    const EdgeRecord& edge = side.edge[e];
    place_corners(side, edge, c, loops.corner + 2 * k);
    const std::uint32_t enters = c.ends & 1, leaves = c.ends >> 3 & 1;
    const std::uint32_t leaving = edge.pairs[of_b], step = std::uint32_t{0x00010001} << 5 * of_b;
    piercings.add(std::rotl(leaving, 16) + side.first_pair + step * c.into, 2 * k, enters);
    piercings.add(leaving + side.first_pair + step * c.out_of, 2 * k + 1, leaves);

    const std::uint32_t first_face = solid / 2 * capacity + of_b * ContactLoops::face_of_b;
    const std::uint32_t left = first_face + edge.left, right = first_face + edge.right;
    loops.span[k] = {solid, e, left, right};
    loops.hub[left] = loops.hub[right] = static_cast<std::uint16_t>(2 * k);
    loops.faces[solid] |= edge.faces;
    loops.faces[solid ^ 1] |= enters << c.into | leaves << c.out_of;
    loops.edges[solid] |= std::uint32_t{1} << e;
  }
}

/// Joins every end to the beginning of the same two faces.
void close_loops(const Piercings& piercings, int faces_a, ContactLoops& loops) {
  std::uint16_t beginning[ContactLoops::max_pairs * face_pairs];  // corner + 1; 0: none
  for (int p = 0; p < loops.pairs; ++p) std::fill_n(beginning + face_pairs * p, capacity * faces_a, std::uint16_t{0});
  for (int k = 0; k < piercings.count; ++k) {
    const std::uint32_t faces = piercings.pairs[k] & 0xFFFF;
    const auto corner = static_cast<std::uint16_t>(piercings.corner[k]);
    beginning[faces] = static_cast<std::uint16_t>(corner + 1);
    loops.hub[faces / capacity] = loops.hub[number_of_b(faces)] = corner;
  }
  std::uint32_t open = 0;
  for (int k = 0; k < piercings.count; ++k) {
    const std::uint32_t faces = piercings.pairs[k] >> 16;
    const std::uint32_t from = beginning[faces];
    beginning[faces] = 0;
    open |= std::uint32_t{from == 0} << faces / face_pairs;
    loops.segment[k] = {faces, (from - 1) % (2 * ContactLoops::max_spans), piercings.corner[k]};
  }
  loops.segments = piercings.count;
  for (int p = 0; p < loops.pairs; ++p) {
    if (open >> p & 1) loops.verdict[p] = LoopVerdict::degenerate;
  }
}

/// No edge of a pair pierces a face: the solids are apart, or one holds the other and all its edges lie inside.
void judge_unpierced(ContactLoops& loops) {
  for (int p = 0; p < loops.pairs; ++p) {
    if (loops.verdict[p] != LoopVerdict::closed) continue;
    const bool a = loops.faces[2 * p] != 0, b = loops.faces[2 * p + 1] != 0;
    if (!a || !b) loops.verdict[p] = a || b ? LoopVerdict::degenerate : LoopVerdict::separated;
  }
}

}  // namespace

void find_contact_loops(std::span<const PlacedPair> pairs, ContactLoops& loops) {
  loops.pairs = static_cast<int>(pairs.size());
  if (pairs.empty()) return;
  EdgeList of_a, of_b;
  double* table = loops.tables;
  for (int p = 0; p < 2 * loops.pairs; ++p) {
    const PlacedPair& pair = pairs[static_cast<std::size_t>(p / 2)];
    loops.distances[p].of = table;
    table += Distances::size(p % 2 == 0 ? *pair.a : *pair.b, p % 2 == 0 ? *pair.b : *pair.a);
  }
  for (int p = 0; p < loops.pairs; ++p) begin(pairs[static_cast<std::size_t>(p)], p, loops, of_a, of_b);
  const PlacedPair& any = pairs.front();
  Crossing crossing[ContactLoops::max_spans + 1];
  loops.spans = find_crossings(loops, any.b->faces(), of_a, crossing, 0);
  loops.spans = find_crossings(loops, any.a->faces(), of_b, crossing, loops.spans);
  Piercings piercings;
  place_spans(crossing, loops, piercings);
  close_loops(piercings, any.a->faces(), loops);
  judge_unpierced(loops);
}

}  // namespace isojam
