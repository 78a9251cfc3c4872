#include "engine/geometry/overlap/own_hessians.hpp"

#include <algorithm>

#include "engine/arithmetic/lanes.hpp"

// The formula of OverlapHessian in blocks of 3×3, one column per register, without a loop over 36 numbers. It has the
// same bits as the plain formula in matrices.

namespace isojam {

namespace {

/// Three columns with three rows; the fourth lanes are arbitrary.
struct Block {
  Lanes column[3];
};

/// Calls function(c) for every column.
template <class Function>
Block by_columns(const Function& function) {
  return {{function(0), function(1), function(2)}};
}

Block operator+(const Block& a, const Block& b) {
  return by_columns([&](int c) { return a.column[c] + b.column[c]; });
}
Block operator-(const Block& a, const Block& b) {
  return by_columns([&](int c) { return a.column[c] - b.column[c]; });
}
Block half(const Block& a) {
  return by_columns([&](int c) { return Lanes::all(0.5) * a.column[c]; });
}

Block transposed(const Block& a) {
  Lanes rows[4];
  rows_of(a.column[0], a.column[1], a.column[2], rows);
  return {{rows[0], rows[1], rows[2]}};
}

struct Blocks {
  Block xx, xt, tx, tt;  ///< blocks of positions (x) and rotations (t)
};

Blocks blocks_of(const Matrix6d& h) {
  const double* p = h.data();
  // The last column has nothing behind it to load. It is loaded with the number before it, and its lanes are rotated.
  const Lanes last = yzwx(Lanes::load(p + 32));
  return {{{Lanes::load(p), Lanes::load(p + 6), Lanes::load(p + 12)}},
          {{Lanes::load(p + 18), Lanes::load(p + 24), Lanes::load(p + 30)}},
          {{Lanes::load(p + 3), Lanes::load(p + 9), Lanes::load(p + 15)}},
          {{Lanes::load(p + 21), Lanes::load(p + 27), last}}};
}

void store(const Block& upper_left, const Block& upper_right, const Block& lower_right, Matrix6d& h) {
  double* p = h.data();
  const Block lower_left = transposed(upper_right);
  const auto put = [p](int column, Lanes upper, Lanes lower) {
    upper.store(p + 6 * column), lower.store(p + 6 * column + 3);  // the next store overwrites the fourth number
  };
  for (int c = 0; c < 3; ++c) put(c, upper_left.column[c], lower_left.column[c]);
  for (int c = 0; c < 2; ++c) put(3 + c, upper_right.column[c], lower_right.column[c]);
  alignas(32) double end[4];
  upper_right.column[2].store(p + 30), lower_right.column[2].store(end);
  std::copy_n(end, 3, p + 33);
}

/// B [r]×. Every column is a difference of two products, rounded like a matrix product.
Block times_skew(const Block& b, Lanes x, Lanes y, Lanes z) {
  const Lanes* c = b.column;
  const Lanes none = Lanes::all(0);
  return {{fma(none - y, c[2], z * c[1]), fma(x, c[2], (none - z) * c[0]), fma(none - x, c[1], y * c[0])}};
}

/// −[v]×.
Block minus_skew(double x, double y, double z) {
  return {{Lanes::of(0, -z, y, 0), Lanes::of(z, 0, -x, 0), Lanes::of(-y, x, 0, 0)}};
}

void set_own(const Blocks& cross, const Block& minus_area, Lanes x, Lanes y, Lanes z, Matrix6d& own) {
  const Block none = by_columns([](int) { return Lanes::all(0); });
  const Block xx = none - cross.xx, xt = times_skew(cross.xx, x, y, z) - cross.xt + minus_area;
  const Block tt = times_skew(cross.tx, x, y, z) - cross.tt;
  store(half(xx + transposed(xx)), half(xt - transposed(cross.tx)), half(tt + transposed(tt)), own);
}

}  // namespace

void set_own_hessians(const Eigen::Vector3d& area, const Eigen::Vector3d& r, OverlapHessian& hessian) {
  const Blocks ab = blocks_of(hessian.ab);
  const Blocks ba{transposed(ab.xx), transposed(ab.tx), transposed(ab.xt), transposed(ab.tt)};
  const Lanes x = Lanes::all(r.x()), y = Lanes::all(r.y()), z = Lanes::all(r.z()), none = Lanes::all(0);
  set_own(ab, minus_skew(area.x(), area.y(), area.z()), x, y, z, hessian.aa);
  set_own(ba, minus_skew(-area.x(), -area.y(), -area.z()), none - x, none - y, none - z, hessian.bb);
}

}  // namespace isojam
