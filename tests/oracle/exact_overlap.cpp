#include "tests/oracle/exact_overlap.hpp"

#include <algorithm>
#include <limits>

namespace isojam::oracle {

namespace {

using Body = ClipPolytope<Real>;

/// 0 for features without a bit.
std::uint64_t bit(std::size_t k) { return k < 64 ? std::uint64_t{1} << k : 0; }

RealVector vector(const Body::Vector& v) { return {v[0], v[1], v[2]}; }

/// Bits of the edges between the sides of the intersection that belong to the faces first … of this solid.
std::uint64_t edges_between(const std::vector<Body::Side>& sides, const ConvexSolid& solid, int first) {
  const auto share = [](const Body::Side& left, const Body::Side& right) {
    for (std::size_t k = 0; k < left.corners.size(); ++k) {
      const auto &tail = left.corners[k], &head = left.corners[(k + 1) % left.corners.size()];
      const auto at = std::find(right.corners.begin(), right.corners.end(), head);
      if (at == right.corners.end() || tail == head) continue;
      if (tail == (at + 1 == right.corners.end() ? right.corners.front() : *(at + 1))) return true;
    }
    return false;
  };
  std::uint64_t found = 0;
  for (std::size_t e = 0; e < solid.edges().size(); ++e) {
    for (const Body::Side& left : sides) {
      for (const Body::Side& right : sides) {
        if (left.face == first + solid.edges()[e].left && right.face == first + solid.edges()[e].right &&
            share(left, right))
          found |= bit(e);
      }
    }
  }
  return found;
}

/// Upper bound for the area of those parts of a triangle that are within `shift` of a face plane of the other solid.
double contested_part(const std::array<Eigen::Vector3d, 3>& corners, const std::vector<HalfSpace<double>>& planes,
                      double shift) {
  const double area = (corners[1] - corners[0]).cross(corners[2] - corners[0]).norm() / 2;
  double contested = 0;
  for (const auto& [n, offset] : planes) {
    std::array<double, 3> depths;
    for (std::size_t k = 0; k < 3; ++k) depths[k] = offset - Eigen::Vector3d(n[0], n[1], n[2]).dot(corners[k]);
    const auto [nearest, farthest] = std::minmax({depths[0], depths[1], depths[2]});
    // The height over the plane is linear. In a triangle that reaches the plane, at most the fraction 2 shift/farthest
    // is within `shift`.
    if (nearest <= shift) contested += farthest <= 2 * shift ? area : area * 2 * shift / farthest;
  }
  return contested;
}

std::vector<HalfSpace<double>> planes_of(const Placed& placed, const Pose& centre) {
  std::vector<HalfSpace<double>> planes;
  for (int f = 0; f < placed.solid.arrays().faces; ++f)
    planes.push_back(half_space<double>(placed.solid, f, placed.pose, centre));
  return planes;
}

ExactOverlap sums_over(const Body& body, const Placed& a, const Placed& b) {
  ExactOverlap result;
  const int faces = a.solid.arrays().faces;
  const auto [area, moment] = body.area_and_moment(faces);
  result.volume = body.volume(), result.area = vector(area), result.moment = vector(moment);
  const double shift = plane_rounding(a.solid, b.solid);
  const auto over_a = planes_of(a, a.pose), over_b = planes_of(b, a.pose);
  body.for_each_triangle(
      [&](const Body::Side& side, const Body::Vector& p, const Body::Vector& q, const Body::Vector& r) {
        const bool is_of_a = side.face < faces;
        (is_of_a ? result.faces_a : result.faces_b) |= bit(static_cast<std::size_t>(side.face - (is_of_a ? 0 : faces)));
        result.contested_area +=
            contested_part({vector(p).cast<double>(), vector(q).cast<double>(), vector(r).cast<double>()},
                           is_of_a ? over_b : over_a, shift);
      });
  result.edges_a = edges_between(body.sides(), a.solid, 0);
  result.edges_b = edges_between(body.sides(), b.solid, faces);
  return result;
}

}  // namespace

double plane_rounding(const ConvexSolid& a, const ConvexSolid& b) {
  return 64 * std::numeric_limits<double>::epsilon() * (a.circumradius() + b.circumradius());
}

template <class T>
ExactOverlap exact_overlap(const Placed& a, const Placed& b) {
  return sums_over(intersection<T>(a.solid, a.pose, b.solid, b.pose).template rounded<Real>(), a, b);
}
template ExactOverlap exact_overlap<Real>(const Placed& a, const Placed& b);
template ExactOverlap exact_overlap<Rational>(const Placed& a, const Placed& b);

ExactOverlap exact_overlap(const PairCase& pair, PairClass pair_class) {
  const Placed a{platonic(pair.a), {}}, b{platonic(pair.b), pair.pose()};
  return is_contested(pair_class) ? exact_overlap<Rational>(a, b) : exact_overlap<Real>(a, b);
}

}  // namespace isojam::oracle
