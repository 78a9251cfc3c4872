#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "engine/packing/energy.hpp"
#include "engine/rigidity/rigidity_matrix.hpp"

namespace isojam {

/// A motion of a pair, in the coordinates of PairStiffness.
using Vector12d = Eigen::Matrix<double, 12, 1>;
/// Second derivatives with respect to these coordinates.
using Matrix12d = Eigen::Matrix<double, 12, 12>;

/// Stiffness of one contact against motions of its two particles. The coordinates are r = {x_A, R_A·θ_A, x_B, R_B·θ_B},
/// where R_A and R_B are the radii of gyration:
///   ∂²E/∂r² = ½ g gᵀ + ½ V W,  g = ∇V,  W = ∇²V  (E = V²/4)
/// The first term opposes the motion that changes V to first order, the normal. The second term contains all other
/// stiffness. One part of it is due to the geometry of the contact, such as an edge that tilts out of a face. The other
/// part is due to the contact force, which rotates and shifts with the contact. A face on a face has no stiffness
/// against a tilt while the depth is positive on the whole polygon in which they overlap, because V is then the area of
/// the polygon times the depth at its centroid. Among the twelve motions, six move the pair as a rigid body, and one is
/// the normal. The other five are called tilts.
struct PairStiffness {
  Vector12d normal;             ///< unit vector g/|g| of the normal
  double normal_stiffness = 0;  ///< stiffness ½ |g|² of the normal, in units of Y·V_p^(1/3)
  double force = 0;             ///< contact force f = V|S|/2, in units of Y·V_p^(2/3)
  double length = 0;            ///< R, the mean of R_A and R_B, in units of V_p^(1/3)
  Matrix12d second;             ///< the second term, ½ V W
  /// The tilts, as columns: orthonormal relative motions of the pair that are perpendicular to the normal and in which
  /// the second term is diagonal. They are sorted by descending stiffness κ_k.
  Eigen::Matrix<double, 12, 5> tilts;
  Eigen::Matrix<double, 5, 1> tilt_stiffness;  ///< stiffness κ_k of each tilt, in units of Y·V_p^(1/3)
  /// False if the second term could not be computed and is set to 0, because the loop of the pair is not closed.
  bool has_second = false;

  /// Stiffness of a tilt relative to f/R, the stiffness that the contact force causes for a rotation: s_k = κ_k R/f. If
  /// only the contact force causes the stiffness, s is of order one. For an edge that lies in a face within the depth
  /// δ, s is of order R/δ or more. If the contact is tilted by an angle α, s ~ δ/(R α²).
  double relative_tilt(int k) const { return tilt_stiffness[k] * length / force; }
  /// stiffness of the normal relative to f/R
  double relative_normal() const { return normal_stiffness * length / force; }
  /// Number of stiff tilts: tilts with s above the threshold.
  int stiff_tilts(double threshold) const;
};

/// Computes the stiffness of every contact, in the order of `contacts`, in double-double and with several threads. The
/// second term is computed separately, and never as a difference, because near jamming it is only 1e-16 of the first
/// term for flat contacts.
std::vector<PairStiffness> pair_stiffnesses(const Packing& packing, std::span<const Contact> contacts);

/// Constraint number by stiffness, without a cut-off angle. The constraints of a contact are its normal and its stiff
/// tilts, and each contact counts for two particles: C_s = (2/N) Σ_c [1 + #{k: s_k > threshold}].
double stiff_constraint_number(int particles, std::span<const PairStiffness> pairs, double threshold);

/// Makes the rigidity matrix with a row of unit length for the normal of each contact, followed by rows for its stiff
/// tilts. It is similar to class_constraints(), but uses the stiffness instead of classes. Throws std::invalid_argument
/// unless `pairs` has one element per contact.
RigidityMatrix stiff_constraints(const Packing& packing, std::span<const Contact> contacts,
                                 std::span<const PairStiffness> pairs, double threshold);

/// Contributions to the stiffness uᵀHu of a motion u, which has 6N entries as in D: uᵀHu = normal + tilt + prestress.
/// `normal` is the first term of all contacts. `tilt` is the part of the second term that belongs to stiff tilts, and
/// `prestress` is the rest of the second term.
struct StiffnessShares {
  double normal = 0, tilt = 0, prestress = 0;  ///< contributions to uᵀHu

  double total() const { return normal + tilt + prestress; }  ///< uᵀHu
};
/// Computes the contributions for a motion. `pairs` must have one element per contact.
StiffnessShares stiffness_shares(std::span<const Contact> contacts, std::span<const PairStiffness> pairs,
                                 double threshold, const Eigen::Ref<const Eigen::VectorXd>& u);

}  // namespace isojam
