#include "engine/geometry/contact_loop.hpp"

#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <type_traits>

#include "engine/geometry/lanes.hpp"

// Phase 1 tabulates the signed distances of either solid's vertices from the other's planes. Phase 2 sees nothing but
// this table: every edge of one solid is clipped by the planes of the other. Where it enters or leaves it pierces a
// face, and there the loop passes from one of the edge's two faces to the other: one segment of the loop ends and the
// next begins. Segments are identified by their pair of faces, so the loop closes if and only if every pair that
// begins also ends, once. No segment is ever found by intersecting two planes, which is ill-conditioned when they
// are nearly parallel.
//
// Contacts are so small that mispredicted branches would cost more than the arithmetic: what differs from pair to pair
// is chosen by masks and selection, and only the lengths of four loops remain unpredictable.

namespace isojam {

namespace {

constexpr int capacity = SolidArrays::capacity;

/// Numbers 0 to 31 in the last bits of four doubles each.
constexpr std::uint64_t tag_bits = 63;
struct Tags {
  alignas(32) std::uint64_t at[capacity];
  constexpr Tags() : at() {
    for (int k = 0; k < capacity; ++k) at[k] = static_cast<std::uint64_t>(k);
  }
};
constexpr Tags tags;

int tag_of(double x) { return static_cast<int>(std::bit_cast<std::uint64_t>(x) & tag_bits); }

/// Calls with the number of plane vectors, as a constant for the Platonic solids.
template <class Function>
void for_vectors(int vectors, const Function& function) {
  switch (vectors) {
    case 1: return function(std::integral_constant<int, 1>{});
    case 2: return function(std::integral_constant<int, 2>{});
    case 3: return function(std::integral_constant<int, 3>{});
    case 5: return function(std::integral_constant<int, 5>{});
    default: return function(vectors);
  }
}

std::uint32_t first_bits(int n) { return static_cast<std::uint32_t>((std::uint64_t{1} << n) - 1); }

/// Vertices that reach into the circumsphere of the other solid, at `to_other` from this one's centre.
std::uint32_t within_reach(const PlacedSolid& body, const Eigen::Vector3d& to_other, double other_radius) {
  const double distance = to_other.norm();
  // The slack is far more than rounding and far less than anything that would cost time.
  const double least = distance * (distance - other_radius * (1 + 1e-9));
  const Lanes x = Lanes::all(to_other.x()), y = Lanes::all(to_other.y()), z = Lanes::all(to_other.z());
  std::uint32_t below = 0;
  for (int v = 0; v < body.vertices(); v += 4) {
    const Lanes along =
        fma(x, Lanes::load(body.x() + v), fma(y, Lanes::load(body.y() + v), z * Lanes::load(body.z() + v)));
    below |= sign_bits(along - Lanes::all(least)) << v;
  }
  return ~below & first_bits(body.vertices());
}

/// Which rows the table needs: of solids with many vertices, those of edges with an end within reach.
void choose_rows(const PlacedSolid& body, const PlacedSolid& other, const Eigen::Vector3d& to_other, Distances& d) {
  constexpr int few = 8;  // so few vertices that choosing costs more than measuring
  const SolidArrays& solid = body.solid().arrays();
  d.rows = first_bits(solid.vertices);
  d.edges = first_bits(solid.edges);
  if (solid.vertices <= few) return;
  std::uint32_t reaching = within_reach(body, to_other, other.solid().circumradius());
  d.rows = d.edges = 0;
  for (; reaching; reaching &= reaching - 1) {
    const int v = std::countr_zero(reaching);
    d.rows |= solid.around[v];
    d.edges |= solid.edges_at[v];
  }
}

void measure(const PlacedSolid& body, const PlacedSolid& other, const Eigen::Vector3d& to_other, Distances& d) {
  d.planes = (other.faces() + 3) & ~3;
  for_vectors(d.planes / 4, [&](auto vectors) {
    Lanes constant[capacity / 4];
    const double *nx = other.nx(), *ny = other.ny(), *nz = other.nz();
    const auto affine = [&](int k, Lanes x, Lanes y, Lanes z, Lanes c) {
      return fma(Lanes::load(nx + 4 * k), x, fma(Lanes::load(ny + 4 * k), y, fma(Lanes::load(nz + 4 * k), z, c)));
    };
    const Lanes x = Lanes::all(-to_other.x()), y = Lanes::all(-to_other.y()), z = Lanes::all(-to_other.z());
    for (int k = 0; k < vectors; ++k)
      constant[k] = affine(k, x, y, z, Lanes::all(0) - Lanes::load(other.offset() + 4 * k));
    for (std::uint32_t rows = d.rows; rows; rows &= rows - 1) {
      const int v = std::countr_zero(rows);
      const Lanes p = Lanes::all(body.x()[v]), q = Lanes::all(body.y()[v]), s = Lanes::all(body.z()[v]);
      double* row = d.of + 4 * vectors * v;
      for (int k = 0; k < vectors; ++k) affine(k, p, q, s, constant[k]).store(row + 4 * k);
    }
  });
}

/// Signs and extremes of the table.
void classify(Distances& d) {
  for_vectors(d.planes / 4, [&](auto vectors) {
    Lanes lowest[capacity / 4];
    Lanes nearest = Lanes::all(std::numeric_limits<double>::infinity());
    for (int k = 0; k < vectors; ++k) lowest[k] = nearest;
    for (std::uint32_t rows = d.rows; rows; rows &= rows - 1) {
      const int v = std::countr_zero(rows);
      const double* row = d.of + 4 * vectors * v;
      for (int k = 0; k < vectors; ++k) {
        const Lanes distance = Lanes::load(row + 4 * k);
        lowest[k] = min(lowest[k], distance);
        nearest = min(nearest, absolute(distance));
        const unsigned inside = sign_bits(distance);
        std::uint8_t& byte = d.inside[k / 2][v];
        byte = static_cast<std::uint8_t>(k % 2 == 0 ? inside | 0xF0U : byte & (inside << 4 | 0x0FU));
      }
    }
    Lanes highest = tagged(lowest[0], tag_bits, tags.at);
    for (int k = 1; k < vectors; ++k) highest = max(highest, tagged(lowest[k], tag_bits, tags.at + 4 * k));
    d.nearest = least(nearest);
    const double found = greatest(highest);
    d.least_penetrated = tag_of(found);
    d.least_penetration = -found;
  });
}

/// Edges that no plane has both ends outside of.
std::uint32_t edges_alive(const SolidArrays& solid, const Distances& d) {
  std::uint32_t alive = d.edges;
  for (int s = 0; 8 * s < d.planes; ++s) {
#ifdef ISOJAM_AVX2
    const auto* inside = reinterpret_cast<const __m128i*>(d.inside[s]);
    const __m256i low = _mm256_broadcastsi128_si256(_mm_load_si128(inside));
    const __m256i high = _mm256_broadcastsi128_si256(_mm_load_si128(inside + 1));
    const auto look_up = [&](const std::uint8_t* vertex) {
      const __m256i at = _mm256_load_si256(reinterpret_cast<const __m256i*>(vertex));
      // A byte index with its top bit set gives 0: that of vertices 16.. in `low`, of 0..15 in `high`.
      return _mm256_or_si256(_mm256_shuffle_epi8(low, _mm256_add_epi8(at, _mm256_set1_epi8(0x70))),
                             _mm256_shuffle_epi8(high, _mm256_sub_epi8(at, _mm256_set1_epi8(16))));
    };
    const __m256i either = _mm256_or_si256(look_up(solid.tail), look_up(solid.head));
    alive &= static_cast<std::uint32_t>(_mm256_movemask_epi8(_mm256_cmpeq_epi8(either, _mm256_set1_epi8(-1))));
#else
    for (int e = 0; e < solid.edges; ++e) {
      const unsigned either = d.inside[s][solid.tail[e]] | d.inside[s][solid.head[e]];
      alive &= ~(std::uint32_t{either != 0xFF} << e);
    }
#endif
  }
  return alive;
}

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

/// One solid's part in the clipping.
struct Side {
  const PlacedSolid& body;
  const Distances& distances;
  Lanes shift;           ///< the solid's centre from that of A; height 0
  const double* height;  ///< of the solid's vertices over the reference plane,
  int height_stride;
  int reference;  ///< column of the reference plane in `distances`; −1 if it is one of the solid's own
  int first_face;
  const std::uint8_t *first, *second;  ///< faces of an edge that a segment begins on where it leaves, and enters
  int own_stride, plane_stride;        ///< of face pairs: own_stride·(own face) + plane_stride·(other face)

  Lanes vertex(int v) const {
    return Lanes::of(body.x()[v], body.y()[v], body.z()[v], height[v * height_stride]) + shift;
  }
};

/// Ends of segments still to be joined to the beginnings of the same face pair.
struct Ends {
  std::uint16_t pair[ContactLoop::max_corners + 1];
  std::uint8_t corner[ContactLoop::max_corners + 1];
  int count = 0;
  std::uint8_t beginning[(capacity + 1) * (capacity + 1)];  ///< by face pair: corner + 1; 0: none
};

/// Where an edge enters and leaves the other solid: the parameter (0 at the tail, 1 at the head), tagged by the plane.
struct Interval {
  double enter, leave;
};

constexpr double at_tail = 0;
constexpr double at_head = 1 + 64 * std::numeric_limits<double>::epsilon();  // past every tagged parameter

template <class Count>
Interval clip(Count vectors, const double* tail, const double* head) {
  const Lanes start = Lanes::all(at_tail), end = Lanes::all(at_head);
  Lanes enter = start, leave = end;
  for (int k = 0; k < vectors; ++k) {
    const Lanes t = Lanes::load(tail + 4 * k), h = Lanes::load(head + 4 * k);
    const Lanes crossing = tagged(t / (t - h), tag_bits, tags.at + 4 * k);
    enter = max(enter, where_negative(t, start, crossing));
    leave = min(leave, where_negative(h, end, crossing));
  }
  return {greatest(enter), least(leave)};
}

/// Weights of tail and head where the edge enters and where it leaves: products of distances, each right to its own
/// last bits however small it is.
Lanes corner_weights(const double* tail, const double* head, int enter_plane, int leave_plane, bool enters,
                     bool leaves) {
  const Lanes pierced = Lanes::of(tail[enter_plane], head[enter_plane], tail[leave_plane], head[leave_plane]);
  const Lanes whole = Lanes::of(0, -1, -1, 0);
  const double e = enters ? 1 : -1, l = leaves ? 1 : -1;
  const Lanes d = where_negative(Lanes::of(e, e, l, l), whole, pierced);
  const Lanes exchanged = swapped_pairs(d);
  return exchanged / (exchanged - d);
}

/// 0 in place of a height that is 0 by construction.
struct HeightMask {
  alignas(32) double of[2][4] = {{1, 1, 1, 1}, {1, 1, 1, 0}};
};
constexpr HeightMask height_mask;

template <class Count>
std::uint32_t clip_edges(Count vectors, const Side& side, std::uint32_t alive, ContactLoop& loop, Ends& ends) {
  const SolidArrays& solid = side.body.solid().arrays();
  std::uint32_t kept_edges = 0;
  const int no_own = solid.faces;
  int spans = loop.spans, count = ends.count;
  for (; alive; alive &= alive - 1) {
    const int e = std::countr_zero(alive);
    const int t = solid.tail[e], h = solid.head[e];
    const double *tail = side.distances.of + 4 * vectors * t, *head = side.distances.of + 4 * vectors * h;
    const Interval inside = clip(vectors, tail, head);
    const bool kept = inside.enter < inside.leave;
    const bool enters = inside.enter != at_tail, leaves = inside.leave != at_head;
    const int enter_plane = enters ? tag_of(inside.enter) : 0, leave_plane = leaves ? tag_of(inside.leave) : 0;
    alignas(32) double weight[4];
    corner_weights(tail, head, enter_plane, leave_plane, enters, leaves).store(weight);

    const Lanes p = side.vertex(t), q = side.vertex(h);
    const Lanes from = fma(p, Lanes::all(weight[0]), q * Lanes::all(weight[1]));
    const Lanes to = fma(p, Lanes::all(weight[2]), q * Lanes::all(weight[3]));
    (from * Lanes::load(height_mask.of[enters & (enter_plane == side.reference)])).store(loop.corner[2 * spans]);
    (to * Lanes::load(height_mask.of[leaves & (leave_plane == side.reference)])).store(loop.corner[2 * spans + 1]);
    const auto corner = static_cast<std::uint8_t>(2 * spans), next = static_cast<std::uint8_t>(2 * spans + 1);
    loop.span[spans] = {corner, next, static_cast<std::uint8_t>(side.first_face + solid.left[e]),
                        static_cast<std::uint8_t>(side.first_face + solid.right[e])};

    // A beginning that is none goes to a place that no pair of faces has.
    const int first = side.own_stride * (kept ? side.first[e] : no_own);
    const int second = side.own_stride * (kept ? side.second[e] : no_own);
    const int into = side.plane_stride * enter_plane, out_of = side.plane_stride * leave_plane;
    const int none = side.own_stride * no_own;
    ends.beginning[enters ? second + into : none] = static_cast<std::uint8_t>(corner + 1);
    ends.pair[count] = static_cast<std::uint16_t>(first + into);
    ends.corner[count] = corner;
    count += kept & enters;
    ends.beginning[leaves ? first + out_of : none] = static_cast<std::uint8_t>(next + 1);
    ends.pair[count] = static_cast<std::uint16_t>(second + out_of);
    ends.corner[count] = next;
    count += kept & leaves;
    spans += kept;
    kept_edges |= std::uint32_t{kept} << e;
  }
  loop.spans = spans;
  ends.count = count;
  return kept_edges;
}

/// Joins every end to the beginning of the same face pair. False if the loop does not close.
bool close_loop(Ends& ends, int stride, ContactLoop& loop) {
  bool open = false;
  for (int k = 0; k < ends.count; ++k) {
    const int pair = ends.pair[k];
    std::uint8_t& beginning = ends.beginning[pair];
    open |= beginning == 0;
    loop.segment[k] = {static_cast<std::uint8_t>((beginning - 1) & (ContactLoop::max_corners - 1)), ends.corner[k],
                       static_cast<std::uint8_t>(pair / stride), static_cast<std::uint8_t>(face_of_b + pair % stride)};
    beginning = 0;
  }
  loop.segments = ends.count;
  return !open;
}

SeparatingAxis face_axis(bool of_a, int face) {
  const auto f = static_cast<std::uint8_t>(face);
  if (of_a) return {SeparatingAxis::Kind::face_a, f, 0};
  return {SeparatingAxis::Kind::face_b, 0, f};
}

/// Whether a face separates; it becomes the loop's axis if it does so beyond the rows of the table and rounding.
bool separated_by_face(const PlacedSolid& a, const PlacedSolid& b, const Eigen::Vector3d& r, ContactLoop& loop) {
  const bool by_b = loop.of_a.least_penetration <= 0, by_a = loop.of_b.least_penetration <= 0;
  if (!by_a && !by_b) return false;
  const SeparatingAxis axis = face_axis(!by_b, (by_b ? loop.of_a : loop.of_b).least_penetrated);
  if (separates(a, b, r, axis)) loop.axis = axis;
  return true;
}

}  // namespace

void find_contact_loop(const PlacedSolid& a, const PlacedSolid& b, const Eigen::Vector3d& r, ContactLoop& loop) {
  loop.verdict = LoopVerdict::separated;
  loop.axis = {};
  loop.spans = loop.segments = 0;
  loop.edges_a = loop.edges_b = 0;
  Distances &of_a = loop.of_a, &of_b = loop.of_b;
  choose_rows(a, b, r, of_a);
  choose_rows(b, a, -r, of_b);
  measure(a, b, r, of_a);
  measure(b, a, -r, of_b);
  classify(of_a);
  classify(of_b);
  if (separated_by_face(a, b, r, loop)) return;

  const double tolerance = gap_tolerance(a.solid(), b.solid(), r);
  loop.verdict = LoopVerdict::degenerate;
  if (of_a.nearest < tolerance && has_vertex_on_plane(of_a, tolerance)) return;
  if (of_b.nearest < tolerance && has_vertex_on_plane(of_b, tolerance)) return;

  const SolidArrays &solid_a = a.solid().arrays(), &solid_b = b.solid().arrays();
  const bool over_b = of_a.least_penetration < of_b.least_penetration;
  const int plane = over_b ? of_a.least_penetrated : of_b.least_penetrated;
  loop.reference = over_b ? face_of_b + plane : plane;
  const int stride = solid_b.faces + 1;
  Ends ends;
  std::memset(ends.beginning, 0, static_cast<std::size_t>((solid_a.faces + 1) * stride));
  const Side side_a{a,
                    of_a,
                    Lanes::all(0),
                    over_b ? of_a.of + plane : solid_a.height[plane],
                    over_b ? of_a.planes : 1,
                    over_b ? plane : -1,
                    0,
                    solid_a.left,
                    solid_a.right,
                    stride,
                    1};
  const Side side_b{b,
                    of_b,
                    Lanes::of(r.x(), r.y(), r.z(), 0),
                    over_b ? solid_b.height[plane] : of_b.of + plane,
                    over_b ? 1 : of_b.planes,
                    over_b ? -1 : plane,
                    face_of_b,
                    solid_b.right,
                    solid_b.left,
                    1,
                    stride};
  for_vectors(of_a.planes / 4, [&](auto vectors) {
    loop.edges_a = clip_edges(vectors, side_a, edges_alive(solid_a, of_a), loop, ends);
  });
  for_vectors(of_b.planes / 4, [&](auto vectors) {
    loop.edges_b = clip_edges(vectors, side_b, edges_alive(solid_b, of_b), loop, ends);
  });
  if (ends.count == 0) {
    // No edge pierces a face: the solids are apart, or one holds the other and all its edges lie inside.
    if (loop.spans == 0) loop.verdict = LoopVerdict::separated;
    return;
  }
  if (close_loop(ends, stride, loop)) loop.verdict = LoopVerdict::closed;
}

}  // namespace isojam
