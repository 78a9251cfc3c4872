#include "engine/geometry/overlap/contact_loop.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <type_traits>

#include "engine/geometry/overlap/loop_numbers.hpp"
#include "engine/geometry/overlap/small_distances.hpp"

// Phase 1 (distances.cpp) tabulates the signed distances of each solid's vertices from the other's planes. For solids
// with many faces it includes only the vertices and planes in the slab between their supports. Phase 2, in this file,
// uses only this table. It clips every edge of one solid by the planes of the other. Where an edge enters or leaves, it
// pierces a face, and the loop passes there from one of the edge's two faces to the other: one segment of the loop ends
// and the next begins. A segment is identified by its pair of faces, so the loop closes if and only if every pair that
// begins also ends, exactly once. No segment is found by intersecting two planes, which is ill-conditioned if they are
// nearly parallel.
//
// Contacts are so small that mispredicted branches would cost more than the arithmetic. Everything that differs from
// pair to pair is therefore chosen by masks and selection, and only the lengths of loops are unpredictable. Each loop
// does one thing, so that the processor overlaps several of its iterations.

namespace isojam {

namespace {

constexpr std::size_t none = std::numeric_limits<std::size_t>::max();

/// True if a vertex lies on a plane within rounding and is not certainly outside another plane.
template <class Solids>
bool has_vertex_on_plane(const Distances<Solids>& d, double tolerance) {
  if (d.nearest >= tolerance) return false;
  bool found = false;
  d.rows.for_each([&](int v) {
    const double* row = d.row(v);
    bool on = false, outside = false;
    for (int f = 0; f < d.planes; ++f) {
      on |= std::abs(row[f]) < tolerance;
      outside |= row[f] >= tolerance;
    }
    found |= on && !outside;
  });
  return found;
}

/// Data of one solid for the loop.
struct Side {
  const EdgeRecord* edge;
  const double* vertex;
  const double* distance;  ///< distances of its vertices from the other solid's planes
  const double* height;    ///< heights of its vertices over the reference plane, `stride` apart
  std::size_t stride;
  const std::uint8_t* face;  ///< face of each column of `distance`
  std::size_t reference;     ///< column of the reference plane in `distance`; none if the plane belongs to this solid
  Lanes shift;               ///< the solid's centre; height 0
};

/// Chooses the reference plane for heights, and fills the data of both solids.
template <class Solids>
inline void prepare(const PlacedSolid& a, const PlacedSolid& b, const Eigen::Vector3d& r, ContactLoop<Solids>& loop,
                    Side* sides) {
  const PlacedSolid* solid[2] = {&a, &b};
  const Distances<Solids>* table[2] = {&loop.of_a, &loop.of_b};
  const Lanes half = Lanes::of(r.x() / 2, r.y() / 2, r.z() / 2, 0);
  sides[0].shift = Lanes::all(0) - half, sides[1].shift = half;
  for (int s = 0; s < 2; ++s) {
    sides[s].edge = solid[s]->solid().arrays().record.data();
    sides[s].vertex = solid[s]->vertex_block(0);
    sides[s].distance = table[s]->of;
    sides[s].face = table[s]->face;
  }
  // Both outcomes are equally likely, so an index replaces the branch.
  const int owner = loop.of_a.least_penetration < loop.of_b.least_penetration, other = 1 - owner;
  const auto plane = static_cast<std::uint32_t>(table[other]->least_penetrated);
  const int face = table[other]->face[plane];
  loop.up = solid[owner]->normal(face);
  sides[owner].height = solid[owner]->solid().arrays().heights_above(face);
  sides[owner].stride = 1, sides[owner].reference = none;
  sides[other].height = table[other]->of + plane;
  sides[other].stride = static_cast<std::uint32_t>(table[other]->planes), sides[other].reference = plane;
}

constexpr double at_tail = 0;
/// The parameter of the head is larger than every tagged parameter.
template <std::uint64_t tags>
constexpr double at_head = 1 + tags* std::numeric_limits<double>::epsilon();

/// Parameters where an edge enters and leaves the other solid (0 at the tail, 1 at the head), tagged by the plane, in
/// every lane. Tags decide the order of parameters that differ by less than 64 ulp, for large solids by less than 128
/// ulp. An edge of the intersection that is so short may be gained or lost, or the loop may not close.
struct Interval {
  Lanes enter, leave;
};

template <std::uint64_t tags, class Count>
inline Interval clip(Count vectors, const double* tail, const double* head) {
  const Lanes start = Lanes::all(at_tail), end = Lanes::all(at_head<tags>);
  Lanes enter = start, leave = end;
  repeat(vectors, [&](int k) {
    const Lanes t = Lanes::load(tail + 4 * k), h = Lanes::load(head + 4 * k);
    const Lanes crossing = tagged<tags>(t / (t - h), 4 * k);
    enter = max(enter, where_negative(t, start, crossing));
    leave = min(leave, where_negative(h, end, crossing));
  });
  return {greatest(enter), least(leave)};
}

/// Finds crossings of the edges in `alive`, where bit 0 is the edge with number `first`. Returns the number of
/// crossings found so far.
template <int limit, class Count>
int find_crossings(Count vectors, const Side* sides, const typename LoopWith<limit>::Set& alive, std::uint32_t first,
                   LoopWith<limit>& loop, int count) {
  constexpr std::uint64_t tags = LoopWith<limit>::tags;
  const Lanes untouched = Lanes::of(at_tail, at_tail, at_head<tags>, at_head<tags>);
  alive.for_each([&](int number) {
    const std::uint32_t at = first + static_cast<std::uint32_t>(number);
    const Side& side = sides[at / Numbers<limit>::edges];
    const EdgeRecord& edge = side.edge[at % Numbers<limit>::edges];
    const std::size_t planes = 4 * static_cast<std::size_t>(vectors);
    const Interval inside = clip<tags>(vectors, side.distance + planes * edge.tail, side.distance + planes * edge.head);
    const auto index = [](std::uint32_t value) { return static_cast<typename LoopWith<limit>::Index>(value); };
    loop.crossing[count] = {index(at), index(tag_of<tags>(inside.enter.first())),
                            index(tag_of<tags>(inside.leave.first())),
                            index(~sign_bits(equal(halves(inside.enter, inside.leave), untouched)))};
    count += inside.enter.first() < inside.leave.first();
  });
  return count;
}

struct Masks {
  /// Negative for an end of an edge that is the edge's own vertex. The index has bit 0 if the edge enters, bit 1 if it
  /// leaves.
  alignas(32) double own_end[4][4] = {{-1, -1, -1, -1}, {1, 1, -1, -1}, {-1, -1, 1, 1}, {1, 1, 1, 1}};
  alignas(32) double whole[4] = {0, -1, -1, 0};
  /// Factor that is 0 for a height that is exactly 0 by construction.
  alignas(32) double height[2][4] = {{1, 1, 1, 1}, {1, 1, 1, 0}};
};
constexpr Masks masks;

/// Computes the two corners of an edge that passes through the other solid.
template <class Crossing>
inline void place_corners(const Side& side, const EdgeRecord& edge, std::size_t planes, const Crossing& c,
                          double (*corner)[4]) {
  const double *tail = side.distance + planes * edge.tail, *head = side.distance + planes * edge.head;
  const std::uint32_t enters = c.enters(), leaves = c.leaves();
  // Weights of tail and head at either end are products of distances, each correct to its last bits even if it is
  // small.
  const Lanes pierced = Lanes::of(tail[c.into], head[c.into], tail[c.out_of], head[c.out_of]);
  const Lanes d = where_negative(Lanes::load(masks.own_end[enters + 2 * leaves]), Lanes::load(masks.whole), pierced);
  const Lanes exchanged = swapped_pairs(d), weight = exchanged / (exchanged - d);
  const auto vertex = [&](std::size_t v, std::size_t at) {
    const double* p = side.vertex + at;
    return Lanes::of(p[0], p[4], p[8], side.height[side.stride * v]) + side.shift;
  };
  const Lanes p = vertex(edge.tail, edge.tail_at), q = vertex(edge.head, edge.head_at);
  const Lanes from = fma(p, lane<0>(weight), q * lane<1>(weight)), to = fma(p, lane<2>(weight), q * lane<3>(weight));
  (from * Lanes::load(masks.height[enters & std::uint32_t{c.into == side.reference}])).store(corner[0]);
  (to * Lanes::load(masks.height[leaves & std::uint32_t{c.out_of == side.reference}])).store(corner[1]);
}

/// The points where edges pierce a face. At each point the segment of one pair of faces begins and that of another pair
/// ends.
template <class Loop>
struct Piercings {
  struct At {
    std::uint32_t pairs;  ///< begins + 2^16·ends
    std::uint32_t corner;
  };
  At at[Loop::max_corners + 1];
  std::size_t count = 0;

  void add(std::uint32_t begins_and_ends, std::uint32_t corner, std::uint32_t real) {
    at[count] = {begins_and_ends, corner};
    count += real;
  }
};

/// `vectors(0)` is the number of vectors of planes that clip the edges of A, `vectors(1)` the one for B.
template <int limit, class Vectors, class Loop>
void place_spans(const Vectors& vectors, const Side* sides, int spans, Loop& loop, Piercings<Loop>& piercings) {
  EdgeSet<limit> edges;
  typename Loop::Set faces[2] = {};
  for (std::uint32_t k = 0; k < static_cast<std::uint32_t>(spans); ++k) {
    typename Loop::Crossing& c = loop.crossing[k];
    const std::uint32_t of_b = c.edge / Numbers<limit>::edges;
    const Side& side = sides[of_b];
    const EdgeRecord& edge = side.edge[c.edge % Numbers<limit>::edges];
    place_corners(side, edge, 4 * static_cast<std::size_t>(vectors(of_b)), c, loop.corner + 2 * k);
    c.into = side.face[c.into], c.out_of = side.face[c.out_of];
    const std::uint32_t enters = c.enters(), leaves = c.leaves();
    const std::uint32_t leaving = Numbers<limit>::pairs(edge, of_b);
    const std::uint32_t step = std::uint32_t{0x00010001} << Numbers<limit>::bits * of_b;
    piercings.add(std::rotl(leaving, 16) + step * c.into, 2 * k, enters);
    piercings.add(leaving + step * c.out_of, 2 * k + 1, leaves);
    const std::uint32_t first = of_b * Loop::face_of_b;
    const std::uint32_t left = first + edge.left, right = first + edge.right;
    loop.span[k] = {static_cast<std::uint8_t>(left), static_cast<std::uint8_t>(right)};
    loop.hub[left] = loop.hub[right] = static_cast<std::uint16_t>(2 * k);
    edges.add(c.edge);
    add_faces(edge, faces[of_b]);
    faces[of_b ^ 1].insert_bits(enters, c.into), faces[of_b ^ 1].insert_bits(leaves, c.out_of);
  }
  loop.spans = spans;
  loop.edge_of_b = Numbers<limit>::edges;
  for (int s = 0; s < 2; ++s) loop.edges[s] = edges.of(s), loop.faces[s] = faces[s];
}

/// Joins every end with the beginning of the same pair of faces. Returns false if the loop does not close.
template <int limit, class Loop>
bool close_loop(const Piercings<Loop>& piercings, int faces_a, Loop& loop) {
  constexpr std::uint32_t faces_of_b = Numbers<limit>::faces;
  using Entry = std::conditional_t<(Numbers<limit>::corners < 256), std::uint8_t, std::uint16_t>;
  alignas(32) Entry beginning[Numbers<limit>::all_pairs];  // corner + 1; 0 means none
  std::memset(beginning, 0, sizeof(Entry) * faces_of_b * static_cast<std::size_t>(faces_a));
  for (std::size_t k = 0; k < piercings.count; ++k) {
    const std::uint32_t pair = piercings.at[k].pairs & 0xFFFF, corner = piercings.at[k].corner;
    beginning[pair] = static_cast<Entry>(corner + 1);
    loop.hub[pair / faces_of_b] = loop.hub[Loop::face_of_b + pair % faces_of_b] = static_cast<std::uint16_t>(corner);
  }
  bool open = false;
  for (std::size_t k = 0; k < piercings.count; ++k) {
    const std::uint32_t pair = piercings.at[k].pairs >> 16;
    const std::uint32_t from = beginning[pair];
    beginning[pair] = 0;
    open |= from == 0;
    // A single store: otherwise the compiler would store the four numbers in four separate loops.
    static_assert(std::endian::native == std::endian::little);
    using Index = typename Loop::Index;
    using Segment = std::conditional_t<sizeof(Index) == 1, std::uint32_t, std::uint64_t>;
    constexpr int bits = 8 * sizeof(Index);
    const Segment faces = pair % faces_of_b | pair / faces_of_b << bits;
    const Segment corners = static_cast<Index>(from - 1) | piercings.at[k].corner << bits;
    loop.segment[k] = std::bit_cast<typename Loop::Segment>(faces | corners << 2 * bits);
  }
  loop.segments = static_cast<int>(piercings.count);
  return !open;
}

/// If one word holds the edges of both solids, a single loop handles them, so that its end is mispredicted only once.
template <int limit, class Count>
int find_all_crossings(Count vectors, const Side* sides, LoopWith<limit>& loop) {
  if constexpr (Numbers<limit>::in_one_word) {
    const std::uint64_t of_a = loop.of_a.edges.word[0], of_b = loop.of_b.edges.word[0];
    return find_crossings<limit>(vectors, sides, BitSet<1>(of_a | of_b << limit), 0, loop, 0);
  } else {
    const int of_a = find_crossings<limit>(vectors, sides, loop.of_a.edges, 0, loop, 0);
    return find_crossings<limit>(vectors, sides, loop.of_b.edges, Numbers<limit>::edges, loop, of_a);
  }
}

template <int limit>
void trace(const PlacedSolid& a, const PlacedSolid& b, const Eigen::Vector3d& r, LoopWith<limit>& loop) {
  Side sides[2];
  prepare(a, b, r, loop, sides);
  const auto vectors_of = [](const auto& d) { return static_cast<int>(static_cast<std::uint32_t>(d.planes) / 4); };
  const int vectors_a = vectors_of(loop.of_a), vectors_b = vectors_of(loop.of_b);
  Piercings<LoopWith<limit>> piercings;
  if (vectors_a == vectors_b) {
    with_vectors(vectors_a, [&](auto vectors) {
      const int spans = find_all_crossings<limit>(vectors, sides, loop);
      place_spans<limit>([=](std::uint32_t) { return vectors; }, sides, spans, loop, piercings);
    });
  } else {
    const int of_a = find_crossings<limit>(vectors_a, sides, loop.of_a.edges, 0, loop, 0);
    const int spans = find_crossings<limit>(vectors_b, sides, loop.of_b.edges, Numbers<limit>::edges, loop, of_a);
    place_spans<limit>([=](std::uint32_t of_b) { return of_b ? vectors_b : vectors_a; }, sides, spans, loop, piercings);
  }
  if (piercings.count == 0) {
    // No edge pierces a face: the solids are separated, or one contains the other and all its edges are inside.
    loop.verdict = loop.spans == 0 ? LoopVerdict::separated : LoopVerdict::degenerate;
  } else {
    loop.verdict = close_loop<limit>(piercings, a.faces(), loop) ? LoopVerdict::closed : LoopVerdict::degenerate;
  }
}

/// True if a face separates the solids. It becomes the loop's axis if it separates all vertices, also those without a
/// row in the table, by more than rounding.
template <class Solids>
bool separated_by_face(const PlacedSolid& a, const PlacedSolid& b, const Eigen::Vector3d& r,
                       ContactLoop<Solids>& loop) {
  using Kind = SeparatingAxis::Kind;
  SeparatingAxis axis;
  if (loop.of_a.least_penetration <= 0) {
    axis = {Kind::face_b, 0, static_cast<std::uint8_t>(loop.of_a.least_penetrated_face())};
  } else if (loop.of_b.least_penetration <= 0) {
    axis = {Kind::face_a, static_cast<std::uint8_t>(loop.of_b.least_penetrated_face()), 0};
  } else {
    return false;
  }
  if (separates(a, b, r, axis)) loop.axis = axis;
  return true;
}

/// For solids with at most this many faces, using all faces is faster than selecting the near ones.
constexpr int few_faces = 8;

/// Phase 1.
template <class Solids>
void tabulate(const PlacedSolid& a, const PlacedSolid& b, const Eigen::Vector3d& r, ContactLoop<Solids>& loop) {
  loop.axis = {};
  loop.origin = r / 2;
  loop.spans = loop.segments = 0;
  loop.of_a.of = loop.tables, loop.of_b.of = loop.tables + Distances<Solids>::size(a, b);
  if (std::max(a.faces(), b.faces()) > few_faces) {
    const Slab<Solids> slab = slab_between<Solids>(a, b, r);
    if (!slab.of_a.faces.empty()) {
      tabulate_near_distances(a, b, r, slab, loop.of_a);
      tabulate_near_distances(b, a, -r, Slab<Solids>{slab.of_b, slab.of_a}, loop.of_b);
      return;
    }
  }
  tabulate_distances(a, b, r, loop.of_a);
  tabulate_distances(b, a, -r, loop.of_b);
}

/// Phase 2; distances below `tolerance` count as zero.
template <int limit>
void judge(const PlacedSolid& a, const PlacedSolid& b, const Eigen::Vector3d& r, double tolerance,
           LoopWith<limit>& loop) {
  loop.verdict = LoopVerdict::separated;
  if (separated_by_face(a, b, r, loop)) return;
  loop.verdict = LoopVerdict::degenerate;
  if (has_vertex_on_plane(loop.of_a, tolerance) || has_vertex_on_plane(loop.of_b, tolerance)) return;
  trace<limit>(a, b, r, loop);
}

}  // namespace

template <int edges>
void find_contact_loop(const PlacedSolid& a, const PlacedSolid& b, const Eigen::Vector3d& r, LoopWith<edges>& loop) {
  tabulate(a, b, r, loop);
  judge<edges>(a, b, r, gap_tolerance(a.solid(), b.solid(), r), loop);
}

template <int edges>
void find_contact_loop(const PlacedSolid& a, const PlacedSolid& b, const DoubleDoubleVector& r, LoopWith<edges>& loop) {
  tabulate(a, b, r.high, loop);
  correct_small_distances(a, b, r, loop.of_a);
  correct_small_distances(b, a, -r, loop.of_b);
  judge<edges>(a, b, r.high, std::numeric_limits<double>::epsilon() * gap_tolerance(a.solid(), b.solid(), r.high),
               loop);
}

template void find_contact_loop<narrow_edges>(const PlacedSolid&, const PlacedSolid&, const Eigen::Vector3d&,
                                              LoopWith<narrow_edges>&);
template void find_contact_loop<wide_edges>(const PlacedSolid&, const PlacedSolid&, const Eigen::Vector3d&,
                                            LoopWith<wide_edges>&);
template void find_contact_loop<large_edges>(const PlacedSolid&, const PlacedSolid&, const Eigen::Vector3d&,
                                             LoopWith<large_edges>&);
template void find_contact_loop<narrow_edges>(const PlacedSolid&, const PlacedSolid&, const DoubleDoubleVector&,
                                              LoopWith<narrow_edges>&);
template void find_contact_loop<wide_edges>(const PlacedSolid&, const PlacedSolid&, const DoubleDoubleVector&,
                                            LoopWith<wide_edges>&);
template void find_contact_loop<large_edges>(const PlacedSolid&, const PlacedSolid&, const DoubleDoubleVector&,
                                             LoopWith<large_edges>&);

}  // namespace isojam
