#include "engine/geometry/refine.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

#include "engine/geometry/lanes.hpp"

namespace isojam {

namespace {

/// n·(y − to_other) − offset, with products of high parts exact and low parts to first order.
double precise_distance(const PlacedSolid& body, int vertex, const PlacedSolid& other, int plane,
                        const TwoDoubleVector& to_other) {
  const TwoDoubleVector n = other.precise_normal(plane), y = body.precise_vertex(vertex);
  TwoDouble sum = -other.precise_offset(plane);
  for (int c = 0; c < 3; ++c) {
    const TwoDouble p = two_sum(y.high[c], -to_other.high[c]);
    const TwoDouble product = two_product(n.high[c], p.high);
    const TwoDouble next = two_sum(sum.high, product.high);
    const double first_order = n.high[c] * (p.low + y.low[c] - to_other.low[c]) + n.low[c] * p.high;
    sum = {next.high, sum.low + (next.low + product.low + first_order)};
  }
  return sum.high + sum.low;
}

std::uint32_t columns_below(double near, const double* row, int columns) {
  std::uint32_t below = 0;
  for (int k = 0; k < columns; k += 4) below |= sign_bits(absolute(Lanes::load(row + k)) - Lanes::all(near)) << k;
  return below;
}

}  // namespace

double refined_below(const ConvexSolid& a, const ConvexSolid& b) { return 2e-3 * std::min(a.inradius(), b.inradius()); }

void refine(const PlacedSolid& body, const PlacedSolid& other, const TwoDoubleVector& to_other, Distances& d) {
  const double near = refined_below(body.solid(), other.solid());
  if (d.nearest >= near) return;
  bool changed_side = false;
  d.nearest = near;
  for (std::uint32_t rows = d.rows; rows; rows &= rows - 1) {
    const int v = std::countr_zero(rows);
    double* row = d.row(v);
    for (std::uint32_t small = columns_below(near, row, d.planes); small; small &= small - 1) {
      const int f = std::countr_zero(small);
      const double distance = precise_distance(body, v, other, f, to_other);
      changed_side |= std::signbit(distance) != std::signbit(row[f]);
      d.nearest = std::min(d.nearest, std::abs(distance));
      row[f] = distance;
    }
  }
  if (changed_side) classify(body.solid(), d);
}

}  // namespace isojam
