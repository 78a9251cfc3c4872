#include "engine/geometry/overlap/distances.hpp"

#include <bit>

#include "engine/geometry/overlap/lanes.hpp"

namespace isojam {

namespace {

constexpr int capacity = SolidArrays::capacity;

std::uint32_t first_bits(int n) { return static_cast<std::uint32_t>((std::uint64_t{1} << n) - 1); }

/// Vertices that reach into the circumsphere of the other solid, at `to_other` from this one's centre.
std::uint32_t within_reach(const PlacedSolid& body, const Eigen::Vector3d& to_other, double other_radius) {
  const double distance = to_other.norm();
  // The slack is far more than rounding and far less than anything that would cost time.
  const Lanes least = Lanes::all(distance * (distance - other_radius * (1 + 1e-9)));
  const Lanes x = Lanes::all(to_other.x()), y = Lanes::all(to_other.y()), z = Lanes::all(to_other.z());
  std::uint32_t below = 0;
  for (int v = 0; v < body.vertices(); v += 4) {
    const double* p = body.vertex_block(v / 4);
    const Lanes along = fma(x, Lanes::load(p), fma(y, Lanes::load(p + 4), z * Lanes::load(p + 8)));
    below |= sign_bits(along - least) << v;
  }
  return ~below & first_bits(body.vertices());
}

/// Signs and extremes of the table, gathered row by row.
template <class Counts>
class Scan {
 public:
  explicit Scan(const Counts& counts) : counts_(counts) {
    repeat(counts.vectors, [&](int k) { lowest_[k] = nearest_; });
  }

  /// Adds vertex v, at `distance(k)` from planes 4k..; the planes it lies inside of, one bit each.
  template <class Row>
  std::uint32_t add(const Row& distance) {
    std::uint32_t inside = 0;
    repeat(counts_.vectors, [&](int k) {
      const Lanes d = distance(k);
      lowest_[k] = min(lowest_[k], d);
      nearest_ = min(nearest_, absolute(d));
      inside |= sign_bits(d) << 4 * k;
    });
    return inside;
  }

  void finish(Distances& d) const {
    Lanes highest = Lanes::all(-SolidArrays::far);
    repeat(counts_.vectors, [&](int k) { highest = max(highest, tagged(lowest_[k], 4 * k)); });
    d.nearest = least(nearest_).first();
    d.least_penetration = -greatest(highest).first();
    d.least_penetrated = static_cast<int>(tag_of(d.least_penetration));
  }

 private:
  Counts counts_;
  Lanes nearest_ = Lanes::all(SolidArrays::far);
  Lanes lowest_[capacity / 4];
};

/// Up to 8 vertices, 8 planes and 16 edges: all rows, and their signs in the bytes of one register.
template <class Counts, class Row>
void scan_all(const Counts& counts, const SolidArrays& solid, const Row& row, Distances& d) {
  Scan scan(counts);
  std::uint64_t inside = 0;
  for (int v = 0; v < counts.vertices; ++v)
    inside |= std::uint64_t{scan.add([&](int k) { return row(v, k); })} << 8 * v;
  scan.finish(d);
  d.edges = equal_unions(inside, solid.tail, solid.head, first_bits(4 * counts.vectors)) & d.candidates;
}

/// Rows of d.rows and edges of d.candidates only.
template <class Counts, class Row>
void scan_rows(const Counts& counts, const SolidArrays& solid, const Row& row, Distances& d) {
  Scan scan(counts);
  std::uint32_t inside[capacity];
  for (std::uint32_t rows = d.rows; rows; rows &= rows - 1) {
    const int v = std::countr_zero(rows);
    inside[v] = scan.add([&](int k) { return row(v, k); });
  }
  scan.finish(d);
  const std::uint32_t all = first_bits(4 * counts.vectors);
  d.edges = 0;
  for (std::uint32_t candidates = d.candidates; candidates; candidates &= candidates - 1) {
    const int e = std::countr_zero(candidates);
    d.edges |= std::uint32_t{(inside[solid.tail[e]] | inside[solid.head[e]]) == all} << e;
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

}  // namespace

void tabulate_distances(const PlacedSolid& body, const PlacedSolid& other, const Eigen::Vector3d& to_other,
                        Distances& d) {
  const SolidArrays& solid = body.solid().arrays();
  with_counts(solid, other.faces(), [&](const auto& counts) {
    d.planes = 4 * counts.vectors;
    const double* normals = other.normal_block(0);
    const auto affine = [=](int k, Lanes x, Lanes y, Lanes z, Lanes c) {
      const double* n = normals + PlacedSolid::block * k;
      return fma(Lanes::load(n), x, fma(Lanes::load(n + 4), y, fma(Lanes::load(n + 8), z, c)));
    };
    Lanes constant[capacity / 4];
    const Lanes x = Lanes::all(-to_other.x()), y = Lanes::all(-to_other.y()), z = Lanes::all(-to_other.z());
    repeat(counts.vectors,
           [&](int k) { constant[k] = affine(k, x, y, z, Lanes::all(0) - Lanes::load(other.offset() + 4 * k)); });
    const auto row = [&](int v, int k) {
      const double* p = body.vertex_at(v);
      const Lanes distance = affine(k, Lanes::all(p[0]), Lanes::all(p[4]), Lanes::all(p[8]), constant[k]);
      distance.store(d.of + 4 * (counts.vectors * v + k));
      return distance;
    };
    if constexpr (few(std::decay_t<decltype(counts)>{})) {
      d.rows = first_bits(counts.vertices), d.candidates = first_bits(counts.edges);
      scan_all(counts, solid, row, d);
    } else {
      d.rows = d.candidates = 0;
      std::uint32_t reaching = within_reach(body, to_other, other.solid().circumradius());
      for (; reaching; reaching &= reaching - 1) {
        const int v = std::countr_zero(reaching);
        d.rows |= solid.around[v], d.candidates |= solid.edges_at[v];
      }
      scan_rows(counts, solid, row, d);
      if (d.rows == 0) d.least_penetrated = 0;  // every plane separates; none was seen
    }
  });
}

void classify(const ConvexSolid& body, Distances& d) {
  const SolidArrays& solid = body.arrays();
  with_counts(solid, d.planes, [&](const auto& counts) {
    const auto row = [&](int v, int k) { return Lanes::load(d.of + 4 * (counts.vectors * v + k)); };
    scan_rows(counts, solid, row, d);
  });
}

}  // namespace isojam
