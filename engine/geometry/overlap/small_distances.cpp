#include "engine/geometry/overlap/small_distances.hpp"

#include <algorithm>
#include <cmath>

#include "engine/arithmetic/lanes.hpp"

namespace isojam {

/// Products of high parts are exact; low parts are included to first order.
DoubleDouble distance_double_double(const PlacedSolid& body, int vertex, const PlacedSolid& other, int plane,
                                    const DoubleDoubleVector& to_other) {
  const DoubleDoubleVector n = other.normal_double_double(plane), y = body.vertex_double_double(vertex);
  DoubleDouble sum = -other.offset_double_double(plane);
  for (int c = 0; c < 3; ++c) {
    const DoubleDouble p = two_sum(y.high[c], -to_other.high[c]);
    const DoubleDouble product = two_product(n.high[c], p.high);
    const DoubleDouble next = two_sum(sum.high, product.high);
    const double first_order = n.high[c] * (p.low + y.low[c] - to_other.low[c]) + n.low[c] * p.high;
    sum = {next.high, sum.low + (next.low + product.low + first_order)};
  }
  return two_sum(sum.high, sum.low);
}

namespace {

template <int words>
BitSet<words> columns_below(double near, const double* row, int columns) {
  BitSet<words> below{};
  for (int k = 0; k < columns; k += 4)
    below.insert_bits(sign_bits(absolute(Lanes::load(row + k)) - Lanes::all(near)), static_cast<std::uint32_t>(k));
  return below;
}

}  // namespace

template <class Solids>
void correct_small_distances(const PlacedSolid& body, const PlacedSolid& other, const DoubleDoubleVector& to_other,
                             Distances<Solids>& d) {
  const double near = double_double_below(body.solid(), other.solid());
  if (d.nearest >= near) return;
  bool changed_side = false;
  d.nearest = near;
  d.rows.for_each([&](int v) {
    double* row = d.row(v);
    columns_below<Solids::words>(near, row, d.planes).for_each([&](int f) {
      const double distance = distance_double_double(body, v, other, d.face[f], to_other).high;
      changed_side |= std::signbit(distance) != std::signbit(row[f]);
      d.nearest = std::min(d.nearest, std::abs(distance));
      row[f] = distance;
    });
  });
  if (changed_side) classify(body.solid(), d);
}

template void correct_small_distances(const PlacedSolid&, const PlacedSolid&, const DoubleDoubleVector&,
                                      Distances<SmallSolids>&);
template void correct_small_distances(const PlacedSolid&, const PlacedSolid&, const DoubleDoubleVector&,
                                      Distances<LargeSolids>&);

}  // namespace isojam
