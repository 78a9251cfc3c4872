#include "engine/geometry/overlap/cross_hessian.hpp"

#include <algorithm>

#include "engine/arithmetic/lanes.hpp"

// Two passes over the segments: the terms are computed for four segments at a time, one per lane; then they are added
// one after the other.

namespace isojam {

namespace {

/// A vector for each of four segments.
struct Four {
  Lanes x, y, z;
};

Four operator+(const Four& a, const Four& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
Four operator-(const Four& a, const Four& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
Four operator*(Lanes s, const Four& a) { return {s * a.x, s * a.y, s * a.z}; }
Four repeated(const Eigen::Vector3d& v) { return {Lanes::all(v.x()), Lanes::all(v.y()), Lanes::all(v.z())}; }
Lanes dot(const Four& a, const Four& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
Lanes length(const Four& a) { return square_root(dot(a, a)); }

Four cross(const Four& a, const Four& b) {
  return {fma_minus(a.y, b.z, a.z * b.y), fma_minus(a.z, b.x, a.x * b.z), fma_minus(a.x, b.y, a.y * b.x)};
}

/// Rounds the products before the subtraction, so that the result is exactly 0 for parallel vectors.
Four plain_cross(const Four& a, const Four& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

/// Four segments of a loop; the last one is repeated if there are fewer.
template <class Loop>
struct Segments {
  using Segment = typename Loop::Segment;
  using Index = typename Loop::Index;
  const Segment* at[4];

  Segments(const Loop& loop, int first) {
    for (int k = 0; k < 4; ++k) at[k] = &loop.segment[std::min(first + k, loop.segments - 1)];
  }

  Four corners(const Loop& loop, Index Segment::*end) const {
    Four corner;
    transpose(loop.corner[at[0]->*end], loop.corner[at[1]->*end], loop.corner[at[2]->*end], loop.corner[at[3]->*end],
              corner.x, corner.y, corner.z);
    return corner;
  }

  Four normals(const PlacedSolid& solid, Index Segment::*face, std::ptrdiff_t to_part = 0) const {
    const auto normal = [&](int k) { return solid.normal_at(static_cast<int>(at[k]->*face)) + to_part; };
    const double *p = normal(0), *q = normal(1), *s = normal(2), *t = normal(3);
    return {Lanes::of(p[0], q[0], s[0], t[0]), Lanes::of(p[4], q[4], s[4], t[4]), Lanes::of(p[8], q[8], s[8], t[8])};
  }
};

/// |n×m| in double.
template <class Loop>
Lanes sine(const PlacedSolid&, const PlacedSolid&, const Segments<Loop>&, const Four& n, const Four& m,
           const Eigen::Vector3d&) {
  return length(plain_cross(n, m));
}

/// The same as |n×(n+m)| or |n×(n−m)|, where the short sum is exact. The result is hence correct to its last bits even
/// for nearly parallel planes.
template <class Loop>
Lanes sine(const PlacedSolid& a, const PlacedSolid& b, const Segments<Loop>& segments, const Four& n, const Four& m,
           const DoubleDoubleVector&) {
  const Lanes sign = where_negative(dot(n, m), Lanes::all(1), Lanes::all(-1));
  const Four n_low = segments.normals(a, &Loop::Segment::face_a, a.to_low());
  const Four m_low = segments.normals(b, &Loop::Segment::face_b, b.to_low());
  return length(plain_cross(n, (n + sign * m) + (n_low + sign * m_low)));
}

const Eigen::Vector3d& rounded(const Eigen::Vector3d& r) { return r; }
const Eigen::Vector3d& rounded(const DoubleDoubleVector& r) { return r.high; }

/// Contributions of four segments to H_AB: rows of n_i, of its torque vector and of d×n_i, and the columns by which
/// they are multiplied.
struct Terms {
  Lanes push[4], lever[4], lever_change[4];
  alignas(32) double push_b[3][4], lever_b[3][4], lever_change_b[3][4];
};

void store(const Four& a, double (*rows)[4]) { a.x.store(rows[0]), a.y.store(rows[1]), a.z.store(rows[2]); }

template <class Displacement, class Loop>
void terms_of(const PlacedSolid& a, const PlacedSolid& b, const Displacement& r, const Loop& loop, int first,
              Terms& terms) {
  using Segment = typename Loop::Segment;
  const Segments segments(loop, first);
  const Four v = segments.corners(loop, &Segment::from), w = segments.corners(loop, &Segment::to);
  const Four n = segments.normals(a, &Segment::face_a), m = segments.normals(b, &Segment::face_b);
  const Four along = w - v, middle = Lanes::all(0.5) * (v + w), from_a = repeated(loop.origin);
  const Four from_b = repeated(loop.origin - rounded(r));
  const Lanes parallel = sine(a, b, segments, n, m, r), none = Lanes::all(0);
  // The mask is negative where sine > 0.
  const Lanes weight = where_negative(none - parallel, length(along) / parallel, none);
  rows_of(n.x, n.y, n.z, terms.push);
  const Four lever = cross(middle + from_a, n), lever_change = cross(along, n);
  rows_of(lever.x, lever.y, lever.z, terms.lever);
  rows_of(lever_change.x, lever_change.y, lever_change.z, terms.lever_change);
  store(weight * m, terms.push_b);
  store(weight * cross(middle + from_b, m), terms.lever_b);
  store(weight * Lanes::all(1.0 / 12) * cross(along, m), terms.lever_change_b);
}

/// The columns of H_AB, each as two halves of three rows.
struct Columns {
  Lanes upper[6], lower[6];

  void add(const Terms& terms, int k) {
    const auto factor = [k](const double(*rows)[4], int c) { return Lanes::all(rows[c][k]); };
    const Lanes push = terms.push[k], lever = terms.lever[k], lever_change = terms.lever_change[k];
    repeat(std::integral_constant<int, 3>{}, [&](int c) {
      const Lanes push_b = factor(terms.push_b, c), lever_b = factor(terms.lever_b, c);
      upper[c] = fma(push, push_b, upper[c]), lower[c] = fma(lever, push_b, lower[c]);
      upper[3 + c] = fma(push, lever_b, upper[3 + c]);
      lower[3 + c] = fma(lever_change, factor(terms.lever_change_b, c), fma(lever, lever_b, lower[3 + c]));
    });
  }

  void store(Matrix6d& h) const {
    // Stores four numbers at a time; the next store overwrites the fourth. The last column is copied separately.
    repeat(std::integral_constant<int, 5>{},
           [&](int c) { upper[c].store(h.data() + 6 * c), lower[c].store(h.data() + 6 * c + 3); });
    alignas(32) double last[4];
    upper[5].store(h.data() + 30), lower[5].store(last);
    std::copy_n(last, 3, h.data() + 33);
  }
};

template <class Displacement, class Loop>
void sum_up(const PlacedSolid& a, const PlacedSolid& b, const Displacement& r, const Loop& loop, Matrix6d& h) {
  Columns sum;
  for (Lanes& column : sum.upper) column = Lanes::all(0);
  for (Lanes& column : sum.lower) column = Lanes::all(0);
  Terms terms;
  for (int first = 0; first < loop.segments; first += 4) {
    terms_of(a, b, r, loop, first, terms);
    for (int k = 0; k < std::min(4, loop.segments - first); ++k) sum.add(terms, k);
  }
  sum.store(h);
}

}  // namespace

template <class Solids>
void set_cross_hessian(const PlacedSolid& a, const PlacedSolid& b, const Eigen::Vector3d& r,
                       const ContactLoop<Solids>& loop, Matrix6d& h) {
  sum_up(a, b, r, loop, h);
}

template <class Solids>
void set_cross_hessian(const PlacedSolid& a, const PlacedSolid& b, const DoubleDoubleVector& r,
                       const ContactLoop<Solids>& loop, Matrix6d& h) {
  sum_up(a, b, r, loop, h);
}

template void set_cross_hessian(const PlacedSolid&, const PlacedSolid&, const Eigen::Vector3d&,
                                const ContactLoop<SmallSolids>&, Matrix6d&);
template void set_cross_hessian(const PlacedSolid&, const PlacedSolid&, const Eigen::Vector3d&,
                                const ContactLoop<LargeSolids>&, Matrix6d&);
template void set_cross_hessian(const PlacedSolid&, const PlacedSolid&, const DoubleDoubleVector&,
                                const ContactLoop<SmallSolids>&, Matrix6d&);
template void set_cross_hessian(const PlacedSolid&, const PlacedSolid&, const DoubleDoubleVector&,
                                const ContactLoop<LargeSolids>&, Matrix6d&);

}  // namespace isojam
