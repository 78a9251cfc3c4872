#include "engine/geometry/refine.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

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

}  // namespace

double refined_below(const ConvexSolid& a, const ConvexSolid& b) { return 2e-3 * std::min(a.inradius(), b.inradius()); }

void refine(const PlacedSolid& body, const PlacedSolid& other, const TwoDoubleVector& to_other, Distances& d) {
  const double near = refined_below(body.solid(), other.solid());
  if (d.nearest >= near) return;
  for (std::uint32_t rows = d.rows; rows; rows &= rows - 1) {
    const int v = std::countr_zero(rows);
    double* row = d.row(v);
    for (int f = 0; f < other.faces(); ++f) {
      if (std::abs(row[f]) < near) row[f] = precise_distance(body, v, other, f, to_other);
    }
  }
  classify(body.solid(), d);
}

}  // namespace isojam
