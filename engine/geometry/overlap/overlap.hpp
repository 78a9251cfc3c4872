#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "engine/geometry/convex_solid.hpp"
#include "engine/geometry/overlap/separating_axis.hpp"
#include "engine/geometry/placed_solid.hpp"
#include "engine/geometry/pose.hpp"

namespace isojam {

/// True if this variant of the engine computes with AVX2 and FMA. Without them results have the same bits and take
/// about five times longer.
bool uses_avx2();
// Variants for other processors have the same headers, so the layout of Eigen's types may not depend on the processor.
static_assert(EIGEN_MAX_ALIGN_BYTES == 0, "compile with EIGEN_DONT_VECTORIZE, as isojam::engine asks for");

/// Algorithm that computed an overlap. `clip` is the slow, more exact path for degenerate pairs, clipped_overlap().
enum class OverlapPath : std::uint8_t { separated, loop, clip };

/// Intersection of solids A and B. Vectors are about A's centre, in the frame in which both solids were given: the lab
/// frame for placed solids, A's body frame if B is given by its pose relative to A.
///   volume  V
///   area    S_A = ½ Σ_C v×w = ∂V/∂x_A, the vector area of A's part of the boundary of the intersection
///   moment  M_A = ∫ r×n dS over A's part = ∂V/∂θ_A
/// For B, S_B = −S_A and, about B's own centre, M_B = −M_A + r×S_A with r = x_B − x_A. V and M in V_p, S in V_p^(2/3).
/// With E = V²/4, the paper's contact model (Smith, Fisher, Alam 2011: E_αβ = Y V²/4V_p), the force on A is
/// F_A = −(V/2) S_A and the torque is T_A = −(V/2) M_A.
/// Bit i of faces_a: face i of A bounds the intersection. Bit e of edges_a: edge e of A has a segment inside B.
struct Overlap {
  double volume = 0;                                 ///< V, V_p
  Eigen::Vector3d area = Eigen::Vector3d::Zero();    ///< S_A, V_p^(2/3)
  Eigen::Vector3d moment = Eigen::Vector3d::Zero();  ///< M_A, V_p
  std::uint64_t faces_a = 0, faces_b = 0;            ///< bits of the faces that bound the intersection
  std::uint64_t edges_a = 0, edges_b = 0;            ///< bits of the edges with a segment inside the other solid
  OverlapPath path = OverlapPath::separated;         ///< algorithm that computed the result

  bool touching() const { return volume > 0; }  ///< true if there is an intersection
};

/// Intersection of A with B, with B's centre at r = x_B − x_A, from the closed loop C where their surfaces intersect.
/// Notation: v → w is a segment of C, on face i of A and face j of B, oriented counter-clockwise seen from outside A.
/// Coordinates are relative to a vertex of the loop, so that no large terms cancel:
///   S_A = ½ Σ_C v×w
///   M_A = −½ Σ_C (w−v)(|v|² + v·w + |w|²)/3
///   V   = Σ_f ∫_f h n_P·n_f dA  over the faces f of the intersection, h the height over the least-penetrated plane P
///       = (1/6) Σ n_P·((v−o)×(w−o)) (h_o+h_v+h_w)  over its edges, for the face left of the edge − the same for the
///         right, o a vertex of the face
/// Heights are interpolated between tabulated plane distances and never computed from coordinates. They are 0 on P and
/// small near it, so that V of a face-face contact is as accurate as the table at any depth.
/// If the loop does not close, or a vertex lies on a face plane within rounding, clipped_overlap() computes the result.
/// The result is correct for the input as given; the function never throws. If the input is in double, its rounding
/// moves faces by 1e-16: at a depth of 1e-13 this is a relative error of V of 3e-3.
/// If a face of A or B separates the solids, `axis` is set to it, for later use with separates().
/// The overload with a DoubleDoubleVector r uses the low parts of A, B and r. The relative errors of V, S and M are
/// then at most 1e-12, however flat or small the contact. Their median is at most 1e-13, and 1e-15 for contacts with
/// V < 1e-8. The error of M is relative to |S| times the inradius.
Overlap overlap(const PlacedSolid& a, const PlacedSolid& b, const Eigen::Vector3d& r, SeparatingAxis& axis);
Overlap overlap(const PlacedSolid& a, const PlacedSolid& b, const DoubleDoubleVector& r, SeparatingAxis& axis);

/// overlap() for solids given by their relative pose; result in A's body frame.
Overlap relative_overlap(const ConvexSolid& a, const ConvexSolid& b, const RelativePose& pose, SeparatingAxis& axis);
Overlap relative_overlap(const ConvexSolid& a, const ConvexSolid& b, const RelativePose& pose);

/// Six numbers per particle, translation first.
using Vector6d = Eigen::Matrix<double, 6, 1>;
/// Second derivatives with respect to two sets of six numbers.
using Matrix6d = Eigen::Matrix<double, 6, 6>;

/// The vector (translation, rotation).
inline Vector6d joined(const Eigen::Vector3d& translation, const Eigen::Vector3d& rotation) {
  Vector6d both;
  both.head<3>() = translation;
  both.tail<3>() = rotation;
  return both;
}

/// Second derivatives of V with respect to (x_A, θ_A) and (x_B, θ_B), with rotations about each body's own centre;
/// frame as in Overlap.
///   H_AB = ab = Σ_C ∫ u_A u_Bᵀ dl / |n_i×n_j|
///   u_A = (n_i, (y−x_A)×n_i)
///   u_B = (n_j, (y−x_B)×n_j)
/// The other blocks follow from H_AB by rigid motion of both bodies:
///   H_AA = −H_AB·Tr − [S_A]× in the (x,θ) block, symmetrised
///   Tr: (a, θ) → (a + θ×r, θ), r = x_B − x_A
/// For H_BB exchange the bodies: H_BAᵀ, S_B = −S_A, −r.
struct OverlapHessian {
  Matrix6d aa, ab, bb;  ///< with respect to (A, A), (A, B) and (B, B)
};

/// overlap() and its Hessian from one loop; `hessian` is overwritten. The Hessian is zero if the loop does not close,
/// because a degenerate pair has no second derivative.
Overlap overlap_with_hessian(const PlacedSolid& a, const PlacedSolid& b, const Eigen::Vector3d& r, SeparatingAxis& axis,
                             OverlapHessian& hessian);
Overlap overlap_with_hessian(const PlacedSolid& a, const PlacedSolid& b, const DoubleDoubleVector& r,
                             SeparatingAxis& axis, OverlapHessian& hessian);

}  // namespace isojam
