#pragma once

#include <Eigen/Core>
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <boost/multiprecision/cpp_int.hpp>
#include <boost/multiprecision/eigen.hpp>
#include <cstdint>
#include <utility>
#include <vector>

#include "tasks/extras/chart/pairs/intersection.hpp"
#include "tasks/extras/chart/pairs/pair_cases.hpp"

namespace isojam {

/// A rational number, for cuts that decide without any error.
using Rational =
    boost::multiprecision::number<boost::multiprecision::cpp_rational_backend, boost::multiprecision::et_off>;
/// A number with 50 decimal digits.
using Real =
    boost::multiprecision::number<boost::multiprecision::cpp_bin_float_50::backend_type, boost::multiprecision::et_off>;
using RealVector = Eigen::Matrix<Real, 3, 1>;

/// The half-space with a denominator of 2^112. Its error of 2e-34 is smaller than that of the solids, and exact
/// arithmetic is far faster with short numbers.
template <>
inline HalfSpace<Rational> half_space(const ConvexSolid& solid, int f, const Pose& pose, const Pose& centre) {
  const HalfSpace<Real> precise = half_space<Real>(solid, f, pose, centre);
  const auto shortened = [](const Real& x) { return Rational(ldexp(round(ldexp(x, 112)), -112)); };
  return {{shortened(precise.normal[0]), shortened(precise.normal[1]), shortened(precise.normal[2])},
          shortened(precise.offset)};
}

/// The solid as a cube that is cut by all its planes. Rounded vertices would make faces that are not exactly planar.
template <>
inline ClipPolytope<Rational> polytope(const ConvexSolid& solid, const Pose& pose) {
  const Rational half(2 * solid.circumradius());
  std::vector<ClipPolytope<Rational>::Side> sides;
  for (std::size_t c = 0; c < 3; ++c) {
    for (const bool upper : {false, true}) {
      sides.emplace_back();
      for (const auto& [u, v] : {std::pair{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}) {
        auto& corner = sides.back().corners.emplace_back();
        corner[c] = upper ? half : Rational(-half);
        corner[(c + 1) % 3] = (upper ? u : v) * half;
        corner[(c + 2) % 3] = (upper ? v : u) * half;
      }
    }
  }
  ClipPolytope<Rational> body(std::move(sides));
  for (int f = 0; f < solid.arrays().faces; ++f) body.clip(half_space<Rational>(solid, f, pose, pose), f);
  return body;
}

}  // namespace isojam

namespace isojam::oracle {

/// A solid in a pose.
struct Placed {
  const ConvexSolid& solid;
  Pose pose;
};

/// Upper limit of the displacement of a face plane by rounding errors of the pose and of the algorithm in double: 64
/// ulp of the size of the pair.
double plane_rounding(const ConvexSolid& a, const ConvexSolid& b);

/// The intersection of A and B with at least 20 correct digits. Vectors are in the lab frame, and moments are about the
/// centre of A.
struct ExactOverlap {
  Real volume = 0;
  RealVector area = RealVector::Zero();    ///< S_A = ∂V/∂x_A
  RealVector moment = RealVector::Zero();  ///< M_A = ∂V/∂θ_A
  /// Upper limit of the effect of rounding on S: the area of those parts of the boundary that can belong to A or to B
  /// if the face planes move by plane_rounding(). It consists of strips along the contact loop, and of whole faces
  /// where faces of A and B coincide or nearly coincide.
  double contested_area = 0;
  /// bits of the first 64 faces and edges of which a part bounds the intersection
  std::uint64_t faces_a = 0, faces_b = 0, edges_a = 0, edges_b = 0;
};

/// Computes the intersection by cutting A with the planes of B in numbers of type T: Rational, or Real for pairs
/// without coinciding faces, for which it is a hundred times faster.
template <class T>
ExactOverlap exact_overlap(const Placed& a, const Placed& b);
/// The overlap of a pair, in rational numbers if its class has faces that coincide or nearly coincide.
ExactOverlap exact_overlap(const PairCase& pair, PairClass pair_class = PairClass::random_contact);

/// True for classes with faces that may coincide or nearly coincide.
inline bool is_contested(PairClass pair_class) { return pair_class >= PairClass::same_orientation; }

}  // namespace isojam::oracle
