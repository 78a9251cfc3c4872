#include "engine/geometry/overlap/distances.hpp"

#include <array>
#include <bit>
#include <cassert>
#include <cstring>

#include "engine/geometry/overlap/lanes.hpp"

namespace isojam {

namespace {

constexpr int capacity = SolidArrays::capacity;

std::uint64_t first_bits(int n) { return (std::uint64_t{1} << n) - 1; }

/// Vertices that reach into the circumsphere of the other solid, whose centre is at `to_other`.
std::uint64_t within_reach(const PlacedSolid& body, const Eigen::Vector3d& to_other, double other_radius) {
  const double distance = to_other.norm();
  // The slack is far larger than rounding, even for sizes that differ by a factor of 1e5, and far too small to cost
  // time.
  const Lanes least = Lanes::all(distance * (distance - other_radius * (1 + 1e-9)));
  const Lanes x = Lanes::all(to_other.x()), y = Lanes::all(to_other.y()), z = Lanes::all(to_other.z());
  std::uint64_t below = 0;
  for (int v = 0; v < body.vertices(); v += 4) {
    const double* p = body.vertex_block(v / 4);
    const Lanes along = fma(x, Lanes::load(p), fma(y, Lanes::load(p + 4), z * Lanes::load(p + 8)));
    below |= std::uint64_t{sign_bits(along - least)} << v;
  }
  return ~below & first_bits(body.vertices());
}

/// Signs and extremes of the table, collected row by row.
template <class Vectors>
class Scan {
 public:
  explicit Scan(Vectors vectors) : vectors_(vectors) {
    repeat(vectors, [&](int k) { lowest_[k] = nearest_; });
  }

  /// Adds vertex v, at `distance(k)` from planes 4k…; returns one bit per plane that it lies inside.
  template <class Row>
  std::uint64_t add(const Row& distance) {
    std::uint64_t inside = 0;
    repeat(vectors_, [&](int k) {
      const Lanes d = distance(k);
      lowest_[k] = min(lowest_[k], d);
      nearest_ = min(nearest_, absolute(d));
      inside |= std::uint64_t{sign_bits(d)} << 4 * k;
    });
    return inside;
  }

  void finish(Distances& d) const {
    Lanes highest = Lanes::all(-SolidArrays::far);
    repeat(vectors_, [&](int k) { highest = max(highest, tagged(lowest_[k], 4 * k)); });
    d.nearest = least(nearest_).first();
    d.least_penetration = -greatest(highest).first();
    d.least_penetrated = static_cast<int>(tag_of(d.least_penetration));
  }

 private:
  Vectors vectors_;
  Lanes nearest_ = Lanes::all(SolidArrays::far);
  Lanes lowest_[capacity / 4];
};

/// For up to 8 vertices, 8 planes and 16 edges: scans all rows, with their signs in the bytes of one register.
template <class Counts, class Row>
void scan_all(const Counts& counts, const SolidArrays& solid, const Row& row, Distances& d) {
  Scan scan(counts.vectors);
  std::uint64_t inside = 0;
  for (int v = 0; v < counts.vertices; ++v) inside |= scan.add([&](int k) { return row(v, k); }) << 8 * v;
  scan.finish(d);
  d.edges = equal_unions(inside, solid.tail, solid.head, (1U << 4 * counts.vectors) - 1) & d.candidates;
}

/// Scans only the rows in d.rows and the edges in d.candidates.
template <class Vectors, class Row>
void scan_rows(Vectors vectors, const SolidArrays& solid, const Row& row, Distances& d) {
  Scan scan(vectors);
  std::uint64_t inside[capacity];
  for (std::uint64_t rows = d.rows; rows; rows &= rows - 1) {
    const int v = std::countr_zero(rows);
    inside[v] = scan.add([&](int k) { return row(v, k); });
  }
  scan.finish(d);
  const std::uint64_t all = first_bits(4 * vectors);
  d.edges = 0;
  for (std::uint64_t candidates = d.candidates; candidates; candidates &= candidates - 1) {
    const int e = std::countr_zero(candidates);
    d.edges |= std::uint64_t{(inside[solid.tail[e]] | inside[solid.head[e]]) == all} << e;
  }
}

template <class Counts>
constexpr bool few(const Counts&) {
  return false;
}
template <int v, int p, int e>
constexpr bool few(const Counts<v, p, e>&) {
  return v <= 8 && p <= 2 && e <= 16;
}

constexpr auto every_face = [] {
  std::array<std::uint8_t, capacity> numbers{};
  for (std::uint8_t k = 0; k < capacity; ++k) numbers[k] = k;
  return numbers;
}();

/// All planes of a solid, in the solid's own memory.
struct AllPlanes {
  const double *normals, *offsets;

  Lanes x(int k) const { return Lanes::load(normals + PlacedSolid::block * k); }
  Lanes y(int k) const { return Lanes::load(normals + PlacedSolid::block * k + 4); }
  Lanes z(int k) const { return Lanes::load(normals + PlacedSolid::block * k + 8); }
  Lanes offset(int k) const { return Lanes::load(offsets + 4 * k); }
};

/// Largest number of vectors for a type of count.
template <class Vectors>
constexpr int room = capacity / 4;
template <int n>
constexpr int room<std::integral_constant<int, n>> = n;

/// Selected planes of a solid, copied together.
template <class Vectors>
class NearPlanes {
 public:
  NearPlanes(Vectors vectors, const PlacedSolid& solid, const std::uint8_t* faces) {
    repeat(vectors, [&](int k) {
      const std::uint8_t* face = faces + 4 * k;
      const double *p = solid.normal_at(face[0]), *q = solid.normal_at(face[1]), *r = solid.normal_at(face[2]),
                   *s = solid.normal_at(face[3]), *offset = solid.offset();
      x_[k] = Lanes::of(p[0], q[0], r[0], s[0]), y_[k] = Lanes::of(p[4], q[4], r[4], s[4]);
      z_[k] = Lanes::of(p[8], q[8], r[8], s[8]);
      offset_[k] = Lanes::of(offset[face[0]], offset[face[1]], offset[face[2]], offset[face[3]]);
    });
  }

  Lanes x(int k) const { return x_[k]; }
  Lanes y(int k) const { return y_[k]; }
  Lanes z(int k) const { return z_[k]; }
  Lanes offset(int k) const { return offset_[k]; }

 private:
  Lanes x_[room<Vectors>], y_[room<Vectors>], z_[room<Vectors>], offset_[room<Vectors>];
};

/// Computes and stores rows of the table.
template <class Vectors, class Planes>
class Rows {
 public:
  Rows(Vectors vectors, const PlacedSolid& body, const Planes& planes, const Eigen::Vector3d& to_other, double* table)
      : vectors_(vectors), planes_(planes), vertices_(body.vertex_block(0)), table_(table) {
    const Lanes x = Lanes::all(-to_other.x()), y = Lanes::all(-to_other.y()), z = Lanes::all(-to_other.z());
    repeat(vectors, [&](int k) { constant_[k] = affine(k, x, y, z, Lanes::all(0) - planes_.offset(k)); });
  }

  Lanes operator()(int v, int k) const {
    const double* p = vertices_ + SolidArrays::at(static_cast<std::uint32_t>(v));
    const Lanes distance = affine(k, Lanes::all(p[0]), Lanes::all(p[4]), Lanes::all(p[8]), constant_[k]);
    distance.store(table_ + 4 * (vectors_ * v + k));
    return distance;
  }

 private:
  Lanes affine(int k, Lanes x, Lanes y, Lanes z, Lanes constant) const {
    return fma(planes_.x(k), x, fma(planes_.y(k), y, fma(planes_.z(k), z, constant)));
  }

  Vectors vectors_;
  const Planes& planes_;
  const double* vertices_;
  double* table_;
  Lanes constant_[capacity / 4];
};

/// Vertices, edges and faces of the stars of these vertices.
Parts parts_at(std::uint64_t vertices, const SolidArrays& solid) {
  Parts all;
  for (; vertices; vertices &= vertices - 1) all |= solid.star[std::countr_zero(vertices)];
  return all;
}

void keep(const Parts& parts, Distances& d) { d.rows = parts.vertices, d.candidates = parts.edges; }

/// Fills the table with all planes of the other solid.
template <class Counts>
void tabulate_all(const Counts& counts, const PlacedSolid& body, const PlacedSolid& other,
                  const Eigen::Vector3d& to_other, Distances& d) {
  const SolidArrays& solid = body.solid().arrays();
  d.planes = 4 * counts.vectors, d.face = every_face.data();
  const AllPlanes planes{other.normal_block(0), other.offset()};
  const Rows row(counts.vectors, body, planes, to_other, d.of);
  if constexpr (few(Counts{})) {
    d.rows = first_bits(counts.vertices), d.candidates = first_bits(counts.edges);
    scan_all(counts, solid, row, d);
  } else {
    keep(parts_at(within_reach(body, to_other, other.solid().circumradius()), solid), d);
    scan_rows(counts.vectors, solid, row, d);
    if (d.rows == 0) d.least_penetrated = 0;  // no vertex is in reach: every plane separates, and no row was scanned
  }
}

}  // namespace

Slab slab_between(const PlacedSolid& a, const PlacedSolid& b, const Eigen::Vector3d& r) {
  Lanes along_a[capacity / 4], along_b[capacity / 4];
  const Lanes x = Lanes::all(r.x()), y = Lanes::all(r.y()), z = Lanes::all(r.z());
  const auto along = [&](const PlacedSolid& body, int k, Lanes from) {
    const double* p = body.vertex_block(k);
    return fma(x, Lanes::load(p), fma(y, Lanes::load(p + 4), fma(z, Lanes::load(p + 8), from)));
  };
  // The padding repeats the first vertex.
  const int blocks_a = (a.vertices() + 3) / 4, blocks_b = (b.vertices() + 3) / 4;
  const Lanes from_b = Lanes::all(r.squaredNorm());
  Lanes highest = along_a[0] = along(a, 0, Lanes::all(0)), lowest = along_b[0] = along(b, 0, from_b);
  for (int k = 1; k < blocks_a; ++k) highest = max(highest, along_a[k] = along(a, k, Lanes::all(0)));
  for (int k = 1; k < blocks_b; ++k) lowest = min(lowest, along_b[k] = along(b, k, from_b));
  // The slack is far larger than rounding, and far too small to cost time.
  const Lanes slack =
      Lanes::all(1e-9 * r.lpNorm<1>() * (r.lpNorm<1>() + a.solid().circumradius() + b.solid().circumradius()));
  const Lanes top = greatest(highest) + slack, bottom = least(lowest) - slack;
  if (top.first() < bottom.first()) return {};
  std::uint64_t out_a = 0, out_b = 0;
  for (int k = 0; k < blocks_a; ++k) out_a |= std::uint64_t{sign_bits(along_a[k] - bottom)} << 4 * k;
  for (int k = 0; k < blocks_b; ++k) out_b |= std::uint64_t{sign_bits(top - along_b[k])} << 4 * k;
  return {parts_at(~out_a & first_bits(a.vertices()), a.solid().arrays()),
          parts_at(~out_b & first_bits(b.vertices()), b.solid().arrays())};
}

void tabulate_distances(const PlacedSolid& body, const PlacedSolid& other, const Eigen::Vector3d& to_other,
                        Distances& d) {
  with_counts(body.solid().arrays(), other.faces(),
              [&](const auto& counts) { tabulate_all(counts, body, other, to_other, d); });
}

void tabulate_near_distances(const PlacedSolid& body, const PlacedSolid& other, const Eigen::Vector3d& to_other,
                             const Slab& slab, Distances& d) {
  assert(slab.of_b.faces != 0);
  int count = 0;
  for (std::uint64_t faces = slab.of_b.faces; faces; faces &= faces - 1)
    d.near_face[count++] = static_cast<std::uint8_t>(std::countr_zero(faces));
  const int vectors = (count + 3) / 4;
  // Padding with a repeated plane changes no result.
  std::memset(d.near_face + count, d.near_face[count - 1], static_cast<std::size_t>(4 * vectors - count));
  d.planes = 4 * vectors, d.face = d.near_face;
  const SolidArrays& solid = body.solid().arrays();
  keep(slab.of_a, d);
  with_vectors(vectors, [&](auto known) {
    const NearPlanes planes(known, other, d.near_face);
    scan_rows(known, solid, Rows(known, body, planes, to_other, d.of), d);
  });
}

void classify(const ConvexSolid& body, Distances& d) {
  const SolidArrays& solid = body.arrays();
  with_vectors(d.planes / 4, [&](auto vectors) {
    const auto row = [&](int v, int k) { return Lanes::load(d.of + 4 * (vectors * v + k)); };
    scan_rows(vectors, solid, row, d);
  });
}

}  // namespace isojam
