#include "engine/geometry/overlap/distances.hpp"

#include <array>
#include <cassert>
#include <cstring>

#include "engine/arithmetic/lanes.hpp"

namespace isojam {

namespace {

/// Vertices beyond the plane that is perpendicular to the line of centres and touches the circumscribed sphere of the
/// other solid on the near side. All vertices inside this sphere are among them. The centre of the other solid is at
/// `to_other`.
template <int words>
BitSet<words> within_reach(const PlacedSolid& body, const Eigen::Vector3d& to_other, double other_radius) {
  const double distance = to_other.norm();
  // The slack is larger than the rounding errors, even for sizes that differ by a factor of 1e5. It is so small that it
  // almost never adds a vertex.
  const Lanes least = Lanes::all(distance * (distance - other_radius * (1 + 1e-9)));
  const Lanes x = Lanes::all(to_other.x()), y = Lanes::all(to_other.y()), z = Lanes::all(to_other.z());
  BitSet<words> below{};
  for (int v = 0; v < body.vertices(); v += 4) {
    const double* p = body.vertex_block(v / 4);
    const Lanes along = fma(x, Lanes::load(p), fma(y, Lanes::load(p + 4), z * Lanes::load(p + 8)));
    below.insert_bits(sign_bits(along - least), static_cast<std::uint32_t>(v));
  }
  return ~below & BitSet<words>::first(body.vertices());
}

/// Collects, row by row, the signs of the distances and their extremes.
template <class Vectors, class Solids>
class Scan {
 public:
  using Set = BitSet<Solids::words>;

  Scan(Vectors vectors, Distances<Solids>& distances) : vectors_(vectors), distances_(distances) {
    repeat(vectors, [&](int k) { lowest_[k] = nearest_; });
  }

  /// Adds the row of one vertex. distance(k) gives its distances from the four planes 4k to 4k + 3. Returns the set of
  /// planes with a negative distance.
  template <class Row>
  Set add(const Row& distance) {
    Set inside{};
    repeat(vectors_, [&](int k) {
      const Lanes d = distance(k);
      lowest_[k] = min(lowest_[k], d);
      nearest_ = min(nearest_, absolute(d));
      inside.insert_bits(sign_bits(d), 4 * static_cast<std::uint32_t>(k));
    });
    return inside;
  }

  void finish() const {
    Distances<Solids>& d = distances_;
    Lanes highest = Lanes::all(-SolidArrays::far);
    repeat(vectors_, [&](int k) { highest = max(highest, tagged<Solids::tags>(lowest_[k], 4 * k)); });
    d.nearest = least(nearest_).first();
    // The plane with the greatest lowest distance is the least penetrated one.
    d.least_penetration = -greatest(highest).first();
    d.least_penetrated = static_cast<int>(tag_of<Solids::tags>(d.least_penetration));
  }

 private:
  Vectors vectors_;
  Distances<Solids>& distances_;
  Lanes nearest_ = Lanes::all(SolidArrays::far);
  Lanes lowest_[Solids::capacity / 4];
};

/// Scans all rows. Requires at most 8 vertices, 8 planes and 16 edges, because the signs of one row are one byte of a
/// 64-bit word.
template <class Counts, class Row>
void scan_all(const Counts& counts, const SolidArrays& solid, const Row& row, Distances<SmallSolids>& d) {
  Scan scan(counts.vectors, d);
  std::uint64_t inside = 0;
  for (int v = 0; v < counts.vertices; ++v) inside |= scan.add([&](int k) { return row(v, k); }).word[0] << 8 * v;
  scan.finish();
  const std::uint32_t all = (1U << 4 * counts.vectors) - 1;
  d.edges = BitSet<1>(equal_unions(inside, solid.tail.data(), solid.head.data(), all)) & d.candidates;
}

/// Scans only the rows in d.rows and the edges in d.candidates.
template <class Vectors, class Row, class Solids>
void scan_rows(Vectors vectors, const SolidArrays& solid, const Row& row, Distances<Solids>& d) {
  using Set = BitSet<Solids::words>;
  Scan scan(vectors, d);
  Set inside[Solids::capacity];
  d.rows.for_each([&](int v) { inside[v] = scan.add([&](int k) { return row(v, k); }); });
  scan.finish();
  const Set all = Set::first(4 * vectors);
  d.edges = {};
  const std::uint8_t *tail = solid.tail.data(), *head = solid.head.data();
  d.candidates.for_each([&](int e) {
    d.edges.insert_bits(std::uint64_t{(inside[tail[e]] | inside[head[e]]) == all}, static_cast<std::uint32_t>(e));
  });
}

template <class Counts>
constexpr bool fits_one_word(const Counts&) {
  return false;
}
template <int v, int p, int e>
constexpr bool fits_one_word(const Counts<v, p, e>&) {
  return v <= 8 && p <= 2 && e <= 16;
}

constexpr auto every_face = [] {
  std::array<std::uint8_t, LargeSolids::capacity> numbers{};
  for (std::size_t k = 0; k < numbers.size(); ++k) numbers[k] = static_cast<std::uint8_t>(k);
  return numbers;
}();

/// All planes of a solid, read from where the solid stores them.
struct AllPlanes {
  const double *normals, *offsets;

  Lanes x(int k) const { return Lanes::load(normals + PlacedSolid::block * k); }
  Lanes y(int k) const { return Lanes::load(normals + PlacedSolid::block * k + 4); }
  Lanes z(int k) const { return Lanes::load(normals + PlacedSolid::block * k + 8); }
  Lanes offset(int k) const { return Lanes::load(offsets + 4 * k); }
};

/// Largest number of groups of four planes. If the number is a compile-time constant, it is this number.
template <class Solids, class Vectors>
constexpr int max_groups = Solids::capacity / 4;
template <class Solids, int n>
constexpr int max_groups<Solids, std::integral_constant<int, n>> = n;

/// Copies of selected planes of a solid, in consecutive memory.
template <class Vectors, class Solids>
class NearPlanes {
 public:
  NearPlanes(Vectors vectors, const PlacedSolid& solid, const Distances<Solids>& d) {
    repeat(vectors, [&](int k) {
      const std::uint8_t* face = d.near_face + 4 * k;
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
  static constexpr int size = max_groups<Solids, Vectors>;
  Lanes x_[size], y_[size], z_[size], offset_[size];
};

/// Computes and stores rows of the table.
template <class Vectors, class Planes, class Solids>
class Rows {
 public:
  Rows(Vectors vectors, const PlacedSolid& body, const Planes& planes, const Eigen::Vector3d& to_other,
       const Distances<Solids>& d)
      : vectors_(vectors), planes_(planes), vertices_(body.vertex_block(0)), table_(d.of) {
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
  Lanes constant_[Solids::capacity / 4];
};

/// The edges and faces that meet in these vertices, and both ends of each edge.
Parts<1> parts_at(const BitSet<1>& vertices, const SolidArrays& solid) {
  Parts<1> all;
  const Parts<1>* star = solid.star.data();
  vertices.for_each([&](int v) { all |= star[v]; });
  return all;
}
template <int words>
Parts<words> parts_at(const BitSet<words>& vertices, const SolidArrays& solid) {
  Parts<words> all;
  for (std::uint32_t e = 0; e < solid.record.size(); ++e) {
    const EdgeRecord& edge = solid.record[e];
    if (!vertices.contains(edge.tail) && !vertices.contains(edge.head)) continue;
    all.vertices.insert(edge.tail), all.vertices.insert(edge.head);
    all.edges.insert(e);
    all.faces.insert(edge.left), all.faces.insert(edge.right);
  }
  return all;
}

template <class Solids>
void select(const Parts<Solids::words>& parts, Distances<Solids>& d) {
  d.rows = parts.vertices, d.candidates = parts.edges;
}

/// Fills the table with the distances from all planes of the other solid.
template <class Counts, class Solids>
void tabulate_all(const Counts& counts, const PlacedSolid& body, const PlacedSolid& other,
                  const Eigen::Vector3d& to_other, Distances<Solids>& d) {
  const SolidArrays& solid = body.solid().arrays();
  d.planes = 4 * counts.vectors, d.face = every_face.data();
  const AllPlanes planes{other.normal_block(0), other.offset()};
  const Rows row(counts.vectors, body, planes, to_other, d);
  if constexpr (fits_one_word(Counts{})) {
    d.rows = BitSet<1>::first(counts.vertices), d.candidates = BitSet<1>::first(counts.edges);
    scan_all(counts, solid, row, d);
  } else {
    select(parts_at(within_reach<Solids::words>(body, to_other, other.solid().circumradius()), solid), d);
    scan_rows(counts.vectors, solid, row, d);
    // If no vertex is in reach, the solids are disjoint, and no row was scanned. The choice of the plane is then
    // arbitrary.
    if (d.rows.empty()) d.least_penetrated = 0;
  }
}

}  // namespace

template <class Solids>
Slab<Solids> slab_between(const PlacedSolid& a, const PlacedSolid& b, const Eigen::Vector3d& r) {
  using Set = BitSet<Solids::words>;
  Lanes along_a[Solids::capacity / 4], along_b[Solids::capacity / 4];
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
  // The slack is larger than the rounding errors. It is so small that it almost never adds a vertex.
  const Lanes slack =
      Lanes::all(1e-9 * r.lpNorm<1>() * (r.lpNorm<1>() + a.solid().circumradius() + b.solid().circumradius()));
  const Lanes top = greatest(highest) + slack, bottom = least(lowest) - slack;
  if (top.first() < bottom.first()) return {};
  Set out_a{}, out_b{};
  for (int k = 0; k < blocks_a; ++k)
    out_a.insert_bits(sign_bits(along_a[k] - bottom), 4 * static_cast<std::uint32_t>(k));
  for (int k = 0; k < blocks_b; ++k) out_b.insert_bits(sign_bits(top - along_b[k]), 4 * static_cast<std::uint32_t>(k));
  return {parts_at(~out_a & Set::first(a.vertices()), a.solid().arrays()),
          parts_at(~out_b & Set::first(b.vertices()), b.solid().arrays())};
}

template <class Solids>
void tabulate_distances(const PlacedSolid& body, const PlacedSolid& other, const Eigen::Vector3d& to_other,
                        Distances<Solids>& d) {
  with_counts<Solids>(body.solid().arrays(), other.faces(),
                      [&](const auto& counts) { tabulate_all(counts, body, other, to_other, d); });
}

template <class Solids>
void tabulate_near_distances(const PlacedSolid& body, const PlacedSolid& other, const Eigen::Vector3d& to_other,
                             const Slab<Solids>& slab, Distances<Solids>& d) {
  assert(!slab.of_b.faces.empty());
  int count = 0;
  slab.of_b.faces.for_each([&](int f) { d.near_face[count++] = static_cast<std::uint8_t>(f); });
  const int vectors = (count + 3) / 4;
  // Padding with a repeated plane changes no result.
  std::memset(d.near_face + count, d.near_face[count - 1], static_cast<std::size_t>(4 * vectors - count));
  d.planes = 4 * vectors, d.face = d.near_face;
  const SolidArrays& solid = body.solid().arrays();
  select(slab.of_a, d);
  with_vectors(vectors, [&](auto known) {
    const NearPlanes planes(known, other, d);
    scan_rows(known, solid, Rows(known, body, planes, to_other, d), d);
  });
}

template <class Solids>
void classify(const ConvexSolid& body, Distances<Solids>& d) {
  const SolidArrays& solid = body.arrays();
  with_vectors(d.planes / 4, [&](auto vectors) {
    const auto row = [&](int v, int k) { return Lanes::load(d.of + 4 * (vectors * v + k)); };
    scan_rows(vectors, solid, row, d);
  });
}

template Slab<SmallSolids> slab_between(const PlacedSolid&, const PlacedSolid&, const Eigen::Vector3d&);
template void tabulate_distances(const PlacedSolid&, const PlacedSolid&, const Eigen::Vector3d&,
                                 Distances<SmallSolids>&);
template void tabulate_near_distances(const PlacedSolid&, const PlacedSolid&, const Eigen::Vector3d&,
                                      const Slab<SmallSolids>&, Distances<SmallSolids>&);
template void classify(const ConvexSolid&, Distances<SmallSolids>&);
template Slab<LargeSolids> slab_between(const PlacedSolid&, const PlacedSolid&, const Eigen::Vector3d&);
template void tabulate_distances(const PlacedSolid&, const PlacedSolid&, const Eigen::Vector3d&,
                                 Distances<LargeSolids>&);
template void tabulate_near_distances(const PlacedSolid&, const PlacedSolid&, const Eigen::Vector3d&,
                                      const Slab<LargeSolids>&, Distances<LargeSolids>&);
template void classify(const ConvexSolid&, Distances<LargeSolids>&);

}  // namespace isojam
