#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "engine/packing/energy.hpp"
#include "engine/rigidity/rigidity_matrix.hpp"

namespace isojam {

/// A motion of a pair, in the coordinates of PairStiffness.
using Vector12d = Eigen::Matrix<double, 12, 1>;
/// A matrix of second derivatives with respect to the coordinates of PairStiffness.
using Matrix12d = Eigen::Matrix<double, 12, 12>;

/// Stiffness of one contact against motions of its two particles. The coordinates are r = {x_A, R_A·θ_A, x_B, R_B·θ_B},
/// where R_A and R_B are the radii of gyration. With E = V²/4, g = ∇V and W = ∇²V,
///   ∂²E/∂r² = ½ g gᵀ + ½ V W.
/// A pair has twelve independent motions. Six of them move it as a rigid body. One is parallel to g and changes V to
/// first order; it is called the normal. The other five are called tilts. The first term opposes only the normal. The
/// second term contains all other stiffness. A part of this stiffness is caused by the geometry of the contact: for
/// example, an edge in a face resists a rotation that lifts one of its ends. The rest is caused by the contact force,
/// which rotates and shifts with the contact. If the depth of a face-face contact is positive on the whole polygon in
/// which the faces overlap, V is the area of the polygon times the depth at its centroid. Such a contact has no stiff
/// tilt.
struct PairStiffness {
  Vector12d normal;             ///< unit vector g/|g| of the normal
  double normal_stiffness = 0;  ///< stiffness ½ |g|² of the normal, in units of Y·V_p^(1/3)
  double force = 0;             ///< contact force f = V|S|/2, in units of Y·V_p^(2/3)
  double length = 0;            ///< length R in relative_tilt(): the mean of R_A and R_B, in units of V_p^(1/3)
  Matrix12d second;             ///< the second term, ½ V W
  /// The tilts, as columns: orthonormal relative motions of the pair that are perpendicular to the normal. The second
  /// term is diagonal in this basis. The tilts are sorted by descending stiffness κ_k.
  Eigen::Matrix<double, 12, 5> tilts;
  Eigen::Matrix<double, 5, 1> tilt_stiffness;  ///< stiffness κ_k of each tilt, in units of Y·V_p^(1/3)
  /// False if the second term could not be computed, because the surfaces of the particles were not found to intersect
  /// in one closed loop (OverlapPath::loop). The term is then 0.
  bool has_second = false;

  /// Stiffness of tilt k relative to f/R, the stiffness that the contact force causes for a rotation: s_k = κ_k R/f. If
  /// only the contact force causes the stiffness, s_k is of order 1. An edge in a face at the depth δ has one tilt with
  /// s_k ~ R/δ. If the edge is tilted out of the face by an angle α, this tilt has s_k ~ δ/(R α²).
  double relative_tilt(int k) const { return tilt_stiffness[k] * length / force; }
  /// stiffness of the normal relative to f/R
  double relative_normal() const { return normal_stiffness * length / force; }
  /// Number of stiff tilts: tilts with s_k above the threshold.
  int stiff_tilts(double threshold) const;
};

/// Computes the stiffness of every contact, in the order of `contacts`, in double-double. For flat contacts near
/// jamming, the second term can be as small as 1e-16 of the first term. It is therefore computed by itself, and not as
/// a difference.
std::vector<PairStiffness> pair_stiffnesses(const Packing& packing, std::span<const Contact> contacts);

/// Constraint number from stiffness, without a cut-off angle: C_s = (2/N) Σ_c [1 + #{k: s_k > threshold}]. The
/// constraints of a contact c are its normal and its stiff tilts. Each contact counts for both of its particles, hence
/// the factor 2.
double stiff_constraint_number(int particles, std::span<const PairStiffness> pairs, double threshold);

/// Makes the rigidity matrix with one row for the normal of each contact, followed by rows for its stiff tilts. In
/// contrast to class_constraints(), the stiffness determines the rows, not the class of the contact. Throws
/// std::invalid_argument unless `pairs` has one element per contact.
RigidityMatrix stiff_constraints(const Packing& packing, std::span<const Contact> contacts,
                                 std::span<const PairStiffness> pairs, double threshold);

/// Contributions to the stiffness uᵀHu of a motion u, where H is the Hessian and u has the 6N entries (x, R·θ) of all
/// particles. `normal` is the sum of the first terms of all contacts. `tilt` is the part of the second terms that
/// belongs to stiff tilts, and `prestress` is the rest of the second terms.
struct StiffnessShares {
  double normal = 0, tilt = 0, prestress = 0;  ///< contributions to uᵀHu

  double total() const { return normal + tilt + prestress; }  ///< uᵀHu
};
/// Computes the contributions for the motion `u`. `pairs` must have one element per contact.
StiffnessShares stiffness_shares(std::span<const Contact> contacts, std::span<const PairStiffness> pairs,
                                 double threshold, const Eigen::Ref<const Eigen::VectorXd>& u);

}  // namespace isojam
