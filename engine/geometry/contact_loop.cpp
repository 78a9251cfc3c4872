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
constexpr int none = 2 * capacity;  // a plane that is not there

/// Numbers 0 to 31 in the last bits of four doubles each.
constexpr std::uint64_t tag_bits = 63;
struct Tags {
  alignas(32) std::uint64_t at[capacity];
  constexpr Tags() : at() {
    for (int k = 0; k < capacity; ++k) at[k] = static_cast<std::uint64_t>(k);
  }
};
constexpr Tags tags;

std::uint32_t tag_of(double x) { return static_cast<std::uint32_t>(std::bit_cast<std::uint64_t>(x) & tag_bits); }

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

/// Signs and extremes of the table, gathered row by row.
template <int capacity_in_lanes>
struct Extremes {
  Lanes lowest[capacity_in_lanes];
  Lanes nearest = Lanes::all(SolidArrays::far);

  explicit Extremes(int vectors) {
    for (int k = 0; k < vectors; ++k) lowest[k] = nearest;
  }

  void add(int k, Lanes distance, unsigned& inside) {
    lowest[k] = min(lowest[k], distance);
    nearest = min(nearest, absolute(distance));
    inside |= sign_bits(distance) << 4 * k;
  }

  template <class Count>
  void finish(Count vectors, Distances& d) const {
    Lanes highest = tagged(lowest[0], tag_bits, tags.at);
    for (int k = 1; k < vectors; ++k) highest = max(highest, tagged(lowest[k], tag_bits, tags.at + 4 * k));
    d.nearest = least(nearest).first();
    d.least_penetration = -greatest(highest).first();
    d.least_penetrated = static_cast<int>(tag_of(d.least_penetration));
  }
};

void measure(const PlacedSolid& body, const PlacedSolid& other, const Eigen::Vector3d& to_other, Distances& d) {
  d.planes = (other.faces() + 3) & ~3;
  for_vectors(d.planes / 4, [&](auto vectors) {
    Lanes constant[capacity / 4];
    const double *nx = other.nx(), *ny = other.ny(), *nz = other.nz(), *offset = other.offset();
    const double *px = body.x(), *py = body.y(), *pz = body.z();
    const auto affine = [=](int k, Lanes x, Lanes y, Lanes z, Lanes c) {
      return fma(Lanes::load(nx + 4 * k), x, fma(Lanes::load(ny + 4 * k), y, fma(Lanes::load(nz + 4 * k), z, c)));
    };
    const Lanes x = Lanes::all(-to_other.x()), y = Lanes::all(-to_other.y()), z = Lanes::all(-to_other.z());
    for (int k = 0; k < vectors; ++k) constant[k] = affine(k, x, y, z, Lanes::all(0) - Lanes::load(offset + 4 * k));
    Extremes<capacity / 4> extremes(vectors);
    for (std::uint32_t rows = d.rows; rows; rows &= rows - 1) {
      const int v = std::countr_zero(rows);
      const Lanes p = Lanes::all(px[v]), q = Lanes::all(py[v]), s = Lanes::all(pz[v]);
      unsigned inside = 0;
      for (int k = 0; k < vectors; ++k) {
        const Lanes distance = affine(k, p, q, s, constant[k]);
        distance.store(d.of + 4 * (vectors * v + k));
        extremes.add(k, distance, inside);
      }
      d.inside[v] = inside;
    }
    extremes.finish(vectors, d);
  });
}

/// Edges that no plane has both ends outside of.
std::uint32_t edges_alive(const SolidArrays& solid, const Distances& d) {
  const std::uint32_t all = first_bits(d.planes);
  std::uint32_t alive = 0;
  for (std::uint32_t edges = d.edges; edges; edges &= edges - 1) {
    const int e = std::countr_zero(edges);
    alive |= std::uint32_t{(d.inside[solid.tail[e]] | d.inside[solid.head[e]]) == all} << e;
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
  const SolidArrays* solid;
  const double *x, *y, *z;
  const double* distance;  ///< the table
  int planes;              ///< and its columns
  const double* height;    ///< of the solid's vertices over the reference plane,
  int height_stride;
  std::uint32_t reference;  ///< column of the reference plane; −1 if it is one of the solid's own
  const std::uint32_t*
      leaving;            ///< per edge, the pairs that begin and end where it leaves, without the face it pierces
  std::uint32_t pierced;  ///< what face 1 of the other solid adds to them
  unsigned first_faces;   ///< numbers of the solid's faces 0, in two bytes
  Lanes shift;            ///< the solid's centre from that of A; height 0

  Lanes vertex(int v) const { return Lanes::of(x[v], y[v], z[v], height[v * height_stride]) + shift; }
};

/// Where an edge pierces a face: the pair of faces whose segment begins there, and the pair whose segment ends.
/// A pair (i, j) is 32i + j.
struct Piercings {
  std::uint64_t at[ContactLoop::max_corners + 1];  ///< begins + 2^16·ends + 2^32·corner
  int count = 0;
};

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
    const Lanes crossing = tagged(t / (t - h), tag_bits, tags.at + 4 * k);
    enter = max(enter, where_negative(t, start, crossing));
    leave = min(leave, where_negative(h, end, crossing));
  }
  return {greatest(enter), least(leave)};
}

/// 0 in place of a height that is 0 by construction.
struct HeightMask {
  alignas(32) double of[2][4] = {{1, 1, 1, 1}, {1, 1, 1, 0}};
};
constexpr HeightMask height_mask;

/// An edge that passes through the other solid: bit 0..31 for those of A, 32.. of B; the planes where it enters and
/// leaves (0 if it does not).
struct Crossing {
  std::uint32_t bit, into, out_of, ends;
};

struct Crossings {
  Crossing at[ContactLoop::max_spans + 1];
  int count = 0;
};

/// `alive`: edges of A, and from bit 32 on of B.
template <class Count>
void find_crossings(Count vectors, const Side* sides, std::uint64_t alive, Crossings& crossings) {
  const Lanes untouched = Lanes::of(at_tail, at_tail, at_head, at_head);
  int count = crossings.count;
  for (; alive; alive &= alive - 1) {
    const auto bit = static_cast<std::uint32_t>(std::countr_zero(alive));
    const Side& side = sides[bit / 32];
    const double* tail = side.distance + 4 * vectors * side.solid->tail[bit % 32];
    const double* head = side.distance + 4 * vectors * side.solid->head[bit % 32];
    const Interval inside = clip(vectors, tail, head);
    crossings.at[count] = {bit, tag_of(inside.enter.first()), tag_of(inside.leave.first()),
                           ~sign_bits(equal(halves(inside.enter, inside.leave), untouched))};
    count += inside.enter.first() < inside.leave.first();
  }
  crossings.count = count;
}

struct EndMask {
  alignas(32) double of[4][4];
};
/// Negative where an end of an edge is its own vertex, by bit 0: it enters, bit 1: it leaves.
constexpr EndMask own_end = {{{-1, -1, -1, -1}, {1, 1, -1, -1}, {-1, -1, 1, 1}, {1, 1, 1, 1}}};

void add_span(const Side& side, const Crossing& c, int k, ContactLoop& loop, Piercings& piercings) {
  const std::uint32_t e = c.bit % 32, enters = c.ends & 1, leaves = c.ends >> 3 & 1;
  const int t = side.solid->tail[e], h = side.solid->head[e];
  const double *tail = side.distance + side.planes * t, *head = side.distance + side.planes * h;
  // Weights of tail and head at either end: products of distances, each right to its own last bits however small.
  const Lanes pierced = Lanes::of(tail[c.into], head[c.into], tail[c.out_of], head[c.out_of]);
  const Lanes d = where_negative(Lanes::load(own_end.of[enters + 2 * leaves]), Lanes::of(0, -1, -1, 0), pierced);
  const Lanes exchanged = swapped_pairs(d);
  const Lanes weight = exchanged / (exchanged - d);
  const Lanes p = side.vertex(t), q = side.vertex(h);
  const Lanes from = fma(p, lane<0>(weight), q * lane<1>(weight)), to = fma(p, lane<2>(weight), q * lane<3>(weight));
  (from * Lanes::load(height_mask.of[enters & std::uint32_t{c.into == side.reference}])).store(loop.corner[2 * k]);
  (to * Lanes::load(height_mask.of[leaves & std::uint32_t{c.out_of == side.reference}])).store(loop.corner[2 * k + 1]);
  loop.span[k] = static_cast<std::uint16_t>(side.solid->sides[e] + side.first_faces);

  const std::uint32_t leaving = side.leaving[e], entering = std::rotl(leaving, 16);
  const std::uint64_t corner = std::uint64_t(2 * k) << 32;
  piercings.at[piercings.count] = corner | (entering + side.pierced * c.into);
  piercings.count += static_cast<int>(enters);
  piercings.at[piercings.count] = (corner + (std::uint64_t{1} << 32)) | (leaving + side.pierced * c.out_of);
  piercings.count += static_cast<int>(leaves);
}

/// Joins every end to the beginning of the same face pair. False if the loop does not close.
bool close_loop(const Piercings& piercings, int faces_a, ContactLoop& loop) {
  std::uint8_t beginning[capacity * capacity];  // corner + 1; 0: none
  std::memset(beginning, 0, static_cast<std::size_t>(capacity * faces_a));
  for (int k = 0; k < piercings.count; ++k)
    beginning[piercings.at[k] & 0xFFFF] = static_cast<std::uint8_t>((piercings.at[k] >> 32) + 1);
  bool open = false;
  for (int k = 0; k < piercings.count; ++k) {
    const unsigned pair = piercings.at[k] >> 16 & 0xFFFF;
    const unsigned from = beginning[pair];
    beginning[pair] = 0;
    open |= from == 0;
    loop.segment[k] = {static_cast<std::uint16_t>((from - 1) % ContactLoop::max_corners),
                       static_cast<std::uint16_t>(piercings.at[k] >> 32), static_cast<std::uint16_t>(pair / capacity),
                       static_cast<std::uint16_t>(face_of_b + pair % capacity)};
  }
  loop.segments = piercings.count;
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

/// Clips the edges of both and closes the loop.
void clip_both(const PlacedSolid& a, const PlacedSolid& b, const Eigen::Vector3d& r, ContactLoop& loop) {
  const Distances &of_a = loop.of_a, &of_b = loop.of_b;
  const SolidArrays &solid_a = a.solid().arrays(), &solid_b = b.solid().arrays();
  const bool over_b = of_a.least_penetration < of_b.least_penetration;
  const int plane = over_b ? of_a.least_penetrated : of_b.least_penetrated;
  loop.reference = over_b ? face_of_b + plane : plane;
  const Side sides[2] = {
      {&solid_a, a.x(), a.y(), a.z(), of_a.of, of_a.planes, over_b ? of_a.of + plane : solid_a.height[plane],
       over_b ? of_a.planes : 1, static_cast<std::uint32_t>(over_b ? plane : none), solid_a.pairs_as_a, 0x00010001, 0,
       Lanes::all(0)},
      {&solid_b, b.x(), b.y(), b.z(), of_b.of, of_b.planes, over_b ? solid_b.height[plane] : of_b.of + plane,
       over_b ? 1 : of_b.planes, static_cast<std::uint32_t>(over_b ? none : plane), solid_b.pairs_as_b,
       0x00010001 * capacity, 0x0101 * face_of_b, Lanes::of(r.x(), r.y(), r.z(), 0)}};
  const std::uint64_t alive_a = edges_alive(solid_a, of_a), alive_b = std::uint64_t{edges_alive(solid_b, of_b)} << 32;
  Crossings crossings;
  if (of_a.planes == of_b.planes) {
    // One loop, so that its end is mispredicted once.
    for_vectors(of_a.planes / 4, [&](auto n) { find_crossings(n, sides, alive_a | alive_b, crossings); });
  } else {
    for_vectors(of_a.planes / 4, [&](auto n) { find_crossings(n, sides, alive_a, crossings); });
    for_vectors(of_b.planes / 4, [&](auto n) { find_crossings(n, sides, alive_b, crossings); });
  }
  Piercings piercings;
  std::uint64_t kept = 0;
  for (int k = 0; k < crossings.count; ++k) {
    const std::uint32_t bit = crossings.at[k].bit;
    kept |= std::uint64_t{1} << bit;
    add_span(sides[bit / 32], crossings.at[k], k, loop, piercings);
  }
  loop.spans = crossings.count;
  loop.edges_a = static_cast<std::uint32_t>(kept), loop.edges_b = static_cast<std::uint32_t>(kept >> 32);
  if (piercings.count == 0) {
    // No edge pierces a face: the solids are apart, or one holds the other and all its edges lie inside.
    if (loop.spans == 0) loop.verdict = LoopVerdict::separated;
  } else if (close_loop(piercings, solid_a.faces, loop)) {
    loop.verdict = LoopVerdict::closed;
  }
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
  if (separated_by_face(a, b, r, loop)) return;

  const double tolerance = gap_tolerance(a.solid(), b.solid(), r);
  loop.verdict = LoopVerdict::degenerate;
  if (of_a.nearest < tolerance && has_vertex_on_plane(of_a, tolerance)) return;
  if (of_b.nearest < tolerance && has_vertex_on_plane(of_b, tolerance)) return;

  clip_both(a, b, r, loop);
}

}  // namespace isojam
