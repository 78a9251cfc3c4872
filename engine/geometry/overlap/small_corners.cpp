#include "engine/geometry/overlap/small_corners.hpp"

#include <algorithm>

#include "engine/arithmetic/lanes.hpp"
#include "engine/geometry/overlap/small_distances.hpp"

// A corner lies on an edge p → q at p + t (q − p), where t = d_p/(d_p − d_q) follows from the distances of p and q from
// a plane. In double the error of a corner is about 1e-16, independent of the size of the contact, and the error of S
// is that times the width of the contact. Here distances, t and corners are in double-double. So are the differences of
// corners and their heights, which are rounded last. Heights are relative to one of the corners too, because the
// reference plane of crossed edges may be far away.

namespace isojam {

namespace {

/// Limit of |S| / width of the loop, in units of fine_below().
constexpr double refined_below = 1e-2;

DoubleDoubleVector operator+(const DoubleDoubleVector& p, const DoubleDoubleVector& q) {
  DoubleDoubleVector sum;
  for (int c = 0; c < 3; ++c) sum.set(c, p[c] + q[c]);
  return sum;
}

DoubleDoubleVector operator-(const DoubleDoubleVector& p, const DoubleDoubleVector& q) { return p + -q; }

DoubleDouble dot(const DoubleDoubleVector& p, const DoubleDoubleVector& q) {
  return p[0] * q[0] + p[1] * q[1] + p[2] * q[2];
}

/// The body whose edge contains a corner, and the body whose plane is pierced there.
struct Side {
  const PlacedSolid *body, *other;
  DoubleDoubleVector to_other, from_a;  ///< from the body's centre to the other's; from A's centre to the body's

  DoubleDoubleVector at_vertex(int vertex) const { return body->vertex_double_double(vertex) + from_a; }

  DoubleDoubleVector at_plane(const EdgeRecord& edge, int plane) const {
    const DoubleDouble tail = distance_double_double(*body, edge.tail, *other, plane, to_other);
    const DoubleDouble head = distance_double_double(*body, edge.head, *other, plane, to_other);
    const DoubleDouble t = tail / (tail - head);
    const DoubleDoubleVector p = body->vertex_double_double(edge.tail);
    const DoubleDoubleVector along = body->vertex_double_double(edge.head) - p;
    DoubleDoubleVector position;
    for (int c = 0; c < 3; ++c) position.set(c, p[c] + t * along[c]);
    return position + from_a;
  }
};

/// Width of the loop, without corners inside.
template <class Solids>
double width(const ContactLoop<Solids>& loop) {
  const auto corner = [&](int k) { return Lanes::load(loop.corner[loop.segment[k].from]); };
  const Lanes first = corner(0);
  Lanes widest = Lanes::all(0);
  for (int k = 1; k < loop.segments; ++k) widest = max(widest, absolute(corner(k) - first));
  return greatest(without_fourth(widest)).first();
}

}  // namespace

template <class Solids>
bool refine_small_corners(const PlacedSolid& a, const PlacedSolid& b, const DoubleDoubleVector& r,
                          const Eigen::Vector3d& area, ContactLoop<Solids>& loop) {
  if (area.norm() >= refined_below * fine_below(a.solid(), b.solid()) * width(loop)) return false;
  const Side sides[2] = {{&a, &b, r, {}}, {&b, &a, -r, r}};
  const DoubleDoubleVector up = loop.of_a.least_penetration < loop.of_b.least_penetration
                                    ? b.normal_double_double(loop.of_a.least_penetrated_face())
                                    : a.normal_double_double(loop.of_b.least_penetrated_face());
  DoubleDoubleVector origin;
  for (int k = 0; k < loop.spans; ++k) {
    const typename ContactLoop<Solids>::Crossing& crossing = loop.crossing[k];
    const Side& side = sides[crossing.edge / loop.edge_of_b];
    const EdgeRecord& edge = side.body->solid().arrays().record[crossing.edge % loop.edge_of_b];
    const DoubleDoubleVector ends[2] = {
        crossing.enters() ? side.at_plane(edge, static_cast<int>(crossing.into)) : side.at_vertex(edge.tail),
        crossing.leaves() ? side.at_plane(edge, static_cast<int>(crossing.out_of)) : side.at_vertex(edge.head)};
    if (k == 0) origin = ends[0];
    for (int end = 0; end < 2; ++end) {
      const DoubleDoubleVector corner = ends[end] - origin;
      std::copy_n(corner.high.data(), 3, loop.corner[2 * k + end]);
      loop.corner[2 * k + end][3] = dot(up, corner).high;
    }
  }
  loop.origin = origin.high;
  return true;
}

template bool refine_small_corners(const PlacedSolid&, const PlacedSolid&, const DoubleDoubleVector&,
                                   const Eigen::Vector3d&, ContactLoop<SmallSolids>&);
template bool refine_small_corners(const PlacedSolid&, const PlacedSolid&, const DoubleDoubleVector&,
                                   const Eigen::Vector3d&, ContactLoop<LargeSolids>&);

}  // namespace isojam
