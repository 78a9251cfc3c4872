#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "engine/geometry/convex_solid.hpp"
#include "engine/geometry/overlap/separating_axis.hpp"
#include "engine/geometry/placed_solid.hpp"
#include "engine/geometry/pose.hpp"

namespace isojam {

// The layout of Eigen's types in the engine and in the program that links it must be the same.
static_assert(EIGEN_MAX_ALIGN_BYTES == 0, "compile with EIGEN_DONT_VECTORIZE, as isojam::engine requires");

/// Algorithm that computed an overlap. separated: a separating axis or distance showed that the solids do not touch.
/// loop: the closed loop in which the surfaces intersect gave the overlap. clip: clipped_overlap() gave it, which is
/// slower and more exact, for degenerate pairs.
enum class OverlapPath : std::uint8_t { separated, loop, clip };

/// Intersection of two solids A and B. Vectors are relative to the centre of A, in the lab frame for placed solids, and
/// in the body frame of A for solids with a relative pose. Quantities:
///   volume  V
///   area    S_A = ∫ n dS = ∂V/∂x_A, the vector area of A's part of the boundary of the intersection
///   moment  M_A = ∫ (y−x_A)×n dS over the points y of A's part = ∂V/∂θ_A
/// For B, S_B = −S_A, and M_B = −M_A + r×S_A about the centre of B, where r = x_B − x_A. V and M are in units of V_p, S
/// in units of V_p^(2/3). With the contact energy E = V²/4 of the paper (Smith, Fisher, Alam 2011: E_αβ = Y V²/4V_p),
/// the force on A is F_A = −(V/2) S_A and the torque on A is T_A = −(V/2) M_A.
struct Overlap {
  double volume = 0;                                 ///< volume V, in units of V_p
  Eigen::Vector3d area = Eigen::Vector3d::Zero();    ///< vector area S_A, in units of V_p^(2/3)
  Eigen::Vector3d moment = Eigen::Vector3d::Zero();  ///< moment M_A, in units of V_p
  FeatureSet faces_a{}, faces_b{};                   ///< sets of the faces that bound the intersection
  FeatureSet edges_a{}, edges_b{};                   ///< sets of the edges with a segment inside the other solid
  OverlapPath path = OverlapPath::separated;         ///< algorithm that computed the result

  bool touching() const { return volume > 0; }  ///< true if the solids intersect
};

/// Computes the intersection of A and B, whose centres have the displacement r = x_B − x_A, from the closed loop C in
/// which the two surfaces intersect. Notation: v → w is a segment of C, on face i of A and face j of B. Segments are
/// oriented counter-clockwise, seen from outside A. Coordinates are relative to the point x_A + p, where p is
/// ContactLoop::origin: the midpoint of the centres, or for very small or narrow contacts in double-double, a corner of
/// the intersection. Then
///   S_A = ½ Σ_C v×w
///   M_A = p×S_A − ½ Σ_C (w−v)(|v|² + v·w + |w|²)/3
///   V   = Σ_f ∫_f h n_P·n_f dA  over the faces f of the intersection, h the height over the least-penetrated plane P
///       = (1/6) Σ [t(left) − t(right)]  over its edges v → w, each with the faces to its left and right;
///         t(f) = n_P·((v−o)×(w−o)) (h_o+h_v+h_w), where o is a vertex of the face f
/// Heights are interpolated from a table of the distances of vertices from planes; only refine_small_corners() computes
/// them from coordinates, in double-double. Because heights are 0 on P and small near P, V of a face-face contact of
/// any depth is as accurate as the table. If the loop is not closed, or if a vertex lies on a face plane within
/// rounding errors, clipped_overlap() computes the result. The function never throws.
///
/// If a face of A or B separates the solids by more than rounding errors, `axis` is set to its normal, for later use
/// with separates(). If only another axis separates them, `axis` is set to Kind::none.
///
/// The result is correct for the coordinates as given, but the rounding of doubles moves faces by 1e-16, which at a
/// depth of 1e-13 causes a relative error of V of 3e-3. The overload with a DoubleDoubleVector r uses A, B and r in
/// double-double. The relative errors of V, S and M are then at most 1e-12, also for very flat and very small contacts,
/// unless the angle between an edge and a face is as small as the depth: the intersection is then much longer than
/// wide, the rounding errors of the coordinates along the edge are large relative to the width, and the bound is
///   1e-12 + 16 ε √(V_s/V), ε = 2.2e-16, V_s the volume of the smaller solid.
/// The median of the errors is at most 1e-13, and without such narrow intersections at most 1e-15 for V < 1e-8. The
/// error of M is relative to |S| times the inradius.
Overlap overlap(const PlacedSolid& a, const PlacedSolid& b, const Eigen::Vector3d& r, SeparatingAxis& axis);
Overlap overlap(const PlacedSolid& a, const PlacedSolid& b, const DoubleDoubleVector& r, SeparatingAxis& axis);

/// Computes the same as overlap() for solids with a relative pose. Vectors of the result are in the body frame of A.
Overlap relative_overlap(const ConvexSolid& a, const ConvexSolid& b, const RelativePose& pose, SeparatingAxis& axis);
Overlap relative_overlap(const ConvexSolid& a, const ConvexSolid& b, const RelativePose& pose);

/// A vector with six components per particle: translation, then rotation.
using Vector6d = Eigen::Matrix<double, 6, 1>;
/// A matrix of second derivatives with respect to two such vectors.
using Matrix6d = Eigen::Matrix<double, 6, 6>;

/// Makes the vector (translation, rotation).
inline Vector6d joined(const Eigen::Vector3d& translation, const Eigen::Vector3d& rotation) {
  Vector6d both;
  both.head<3>() = translation;
  both.tail<3>() = rotation;
  return both;
}

/// Second derivatives of V with respect to (x_A, θ_A) and (x_B, θ_B). Each body rotates about its own centre. Vectors
/// are in the same frame as in Overlap.
///   H_AB = ab = Σ_C ∫ u_A u_Bᵀ dl / |n_i×n_j|
///   u_A = (n_i, (y−x_A)×n_i)
///   u_B = (n_j, (y−x_B)×n_j)
/// The other blocks follow from H_AB, because a rigid motion of both bodies together does not change V:
///   H_AA = −H_AB·Tr − X, symmetrised, where X is [S_A]× in the (x, θ) block and 0 in the other three
///   Tr: (a, θ) → (a + θ×r, θ), r = x_B − x_A
/// H_BB follows in the same way from H_BA = H_ABᵀ, S_B = −S_A and −r.
struct OverlapHessian {
  Matrix6d aa, ab, bb;  ///< blocks for the coordinates of (A, A), (A, B) and (B, B)
};

/// Computes overlap() and the Hessian of V from the same loop, and overwrites `hessian`. It is zero if the solids are
/// separated, or if clipped_overlap() computed V, because V of a degenerate pair has no second derivative.
Overlap overlap_with_hessian(const PlacedSolid& a, const PlacedSolid& b, const Eigen::Vector3d& r, SeparatingAxis& axis,
                             OverlapHessian& hessian);
Overlap overlap_with_hessian(const PlacedSolid& a, const PlacedSolid& b, const DoubleDoubleVector& r,
                             SeparatingAxis& axis, OverlapHessian& hessian);

}  // namespace isojam
