#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "engine/geometry/convex_solid.hpp"
#include "engine/geometry/overlap/separating_axis.hpp"
#include "engine/geometry/placed_solid.hpp"
#include "engine/geometry/pose.hpp"

namespace isojam {

/// Which way an overlap was found. `clip` is the slow, exact-minded path for degenerate pairs, clipped_overlap().
enum class OverlapPath : std::uint8_t { separated, loop, clip };

/// Intersection of solids A and B. Vectors are taken about A's centre, in the frame that both solids were given in: the
/// lab for placed solids, A's body frame where B is given by its pose relative to A.
///   volume  V
///   area    S_A = ½ Σ_C v×w = ∂V/∂x_A, the vector area of A's part of the boundary of the intersection
///   moment  M_A = ∫ r×n dS over A's part = ∂V/∂θ_A
/// B has S_B = −S_A and, about its own centre, M_B = −M_A + r×S_A, r = x_B − x_A. V and M in V_p, S in V_p^(2/3).
/// With E = V²/4, the paper's contact model (Smith, Fisher, Alam 2011: E_αβ = Y V²/4V_p), the force on A is
/// F_A = −(V/2) S_A and the torque T_A = −(V/2) M_A.
/// Bit i of faces_a: face i of A bounds the intersection. Bit e of edges_a: edge e of A has a segment inside B.
struct Overlap {
  double volume = 0;                                 ///< V, V_p
  Eigen::Vector3d area = Eigen::Vector3d::Zero();    ///< S_A, V_p^(2/3)
  Eigen::Vector3d moment = Eigen::Vector3d::Zero();  ///< M_A, V_p
  std::uint64_t faces_a = 0, faces_b = 0;            ///< bits of the faces that bound the intersection
  std::uint64_t edges_a = 0, edges_b = 0;            ///< bits of the edges with a segment inside the other
  OverlapPath path = OverlapPath::separated;         ///< which way the answer came

  bool touching() const { return volume > 0; }  ///< whether there is an intersection
};

/// Intersection of A with B, B's centre at r = x_B − x_A, by the closed loop where their surfaces cross. Notation:
/// v → w is a segment of the loop C, on face i of A and face j of B, oriented counter-clockwise seen from outside A;
/// coordinates from a vertex of the loop, so that nothing large cancels:
///   S_A = ½ Σ_C v×w
///   M_A = −½ Σ_C (w−v)(|v|² + v·w + |w|²)/3
///   V   = Σ_f ∫_f h n_P·n_f dA  over the faces f of the intersection, h the height over the least-penetrated plane P
///       = (1/6) Σ n_P·((v−o)×(w−o)) (h_o+h_v+h_w)  over its edges, for the face left of the edge − the same for the
///         right, o a vertex of the face
/// Heights are interpolated between tabulated plane distances, never taken from coordinates: they are 0 on P and small
/// near it, so that V of two faces in contact is as accurate as the table at any depth.
/// If the loop does not close, or a vertex lies on a face plane to within rounding, the answer comes from
/// clipped_overlap(). Never silently wrong, if the input is right to the last bit of what it is given in; never throws.
/// In doubles rounding of the input moves faces by 1e-16: at a depth of 1e-13 V is off by 3e-3 of itself.
/// If a face of A or B separates the solids, `axis` is set to it, for later use with separates().
/// A DoubleDoubleVector r makes use of the low parts of A, B and r: V, S and M are then right to 1e-12 of themselves,
/// half of them to 1e-13, and of contacts below V 1e-8 to 1e-15, however flat or small; M over |S| times the inradius.
Overlap overlap(const PlacedSolid& a, const PlacedSolid& b, const Eigen::Vector3d& r, SeparatingAxis& axis);
Overlap overlap(const PlacedSolid& a, const PlacedSolid& b, const DoubleDoubleVector& r, SeparatingAxis& axis);

/// overlap() of solids given by their relative pose, in A's body frame.
Overlap relative_overlap(const ConvexSolid& a, const ConvexSolid& b, const RelativePose& pose, SeparatingAxis& axis);
Overlap relative_overlap(const ConvexSolid& a, const ConvexSolid& b, const RelativePose& pose);

/// Six numbers of a particle, translation first.
using Vector6d = Eigen::Matrix<double, 6, 1>;
/// Second derivatives by these.
using Matrix6d = Eigen::Matrix<double, 6, 6>;

/// Vector (translation, rotation).
inline Vector6d joined(const Eigen::Vector3d& translation, const Eigen::Vector3d& rotation) {
  Vector6d both;
  both.head<3>() = translation;
  both.tail<3>() = rotation;
  return both;
}

/// Second derivatives of V by (x_A, θ_A) and (x_B, θ_B), rotations about each body's own centre; frame as in Overlap.
///   H_AB = ab = Σ_C ∫ u_A u_Bᵀ dl / |n_i×n_j|
///   u_A = (n_i, (y−x_A)×n_i)
///   u_B = (n_j, (y−x_B)×n_j)
/// The other blocks follow from it by rigid motion of both bodies.
///   H_AA = −H_AB·Tr − [S_A]× in the (x,θ) block, symmetrised
///   Tr: (a, θ) → (a + θ×r, θ), r = x_B − x_A
/// For H_BB exchange the bodies: H_BAᵀ, S_B = −S_A, −r.
struct OverlapHessian {
  Matrix6d aa, ab, bb;  ///< by (A, A), (A, B) and (B, B)
};

/// overlap() and its Hessian, overwritten, from one loop. The Hessian is zero where the loop does not close: a
/// degenerate pair has no second derivative.
Overlap overlap_with_hessian(const PlacedSolid& a, const PlacedSolid& b, const Eigen::Vector3d& r, SeparatingAxis& axis,
                             OverlapHessian& hessian);
Overlap overlap_with_hessian(const PlacedSolid& a, const PlacedSolid& b, const DoubleDoubleVector& r,
                             SeparatingAxis& axis, OverlapHessian& hessian);

}  // namespace isojam
