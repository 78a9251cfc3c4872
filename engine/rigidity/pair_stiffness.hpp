#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "engine/packing/energy.hpp"
#include "engine/rigidity/rigidity_matrix.hpp"

namespace isojam {

/// Coordinates of a pair, as in PairStiffness.
using Vector12d = Eigen::Matrix<double, 12, 1>;
/// Second derivatives with respect to them.
using Matrix12d = Eigen::Matrix<double, 12, 12>;

/// Stiffness of one contact against motions of its two particles, r = {x_A, R_A·θ_A, x_B, R_B·θ_B}, R radii of
/// gyration:
///   ∂²E/∂r² = ½ g gᵀ + ½ V W,  g = ∇V,  W = ∇²V  (E = V²/4)
/// The first term opposes motions that change V to first order, that is, along the normal. All other stiffness is in
/// the second term. It contains the tilts of faces and of edges in a face, which are geometric, and the prestress: the
/// effect of the force when it rotates and shifts with the contact. (A face flat on a face has no tilt stiffness: V is
/// the area of the polygon times the depth at its centroid, until the faces separate within the polygon.) Of the twelve
/// directions six move the pair as a whole and one is the normal; five remain.
struct PairStiffness {
  Vector12d normal;             ///< g/|g|
  double normal_stiffness = 0;  ///< ½ |g|², Y·V_p^(1/3)
  double force = 0;             ///< f = V|S|/2, Y·V_p^(2/3)
  double length = 0;            ///< R, mean of both, V_p^(1/3)
  Matrix12d second;             ///< ½ V W
  /// Orthonormal relative motions of the pair, perpendicular to the normal, in which the second term is diagonal; and
  /// their stiffness κ, descending.
  Eigen::Matrix<double, 12, 5> tilts;
  Eigen::Matrix<double, 5, 1> tilt_stiffness;  ///< κ_k, Y·V_p^(1/3)
  /// False if the second term is unknown and set to 0, because the loop of the pair does not close.
  bool has_second = false;

  /// Stiffness in units of f/R, the stiffness that the contact's own force causes for a rotation: s_k = κ_k R/f. It is
  /// of order one for prestress. For an edge that lies in a face to within its depth δ, and for tilts of such faces, it
  /// is 1/δ or more. For a contact tilted by α from flat, s ~ δ/(R α²).
  double relative_tilt(int k) const { return tilt_stiffness[k] * length / force; }
  double relative_normal() const { return normal_stiffness * length / force; }  ///< the same ratio for the normal
  /// Number of tilts with s above the threshold.
  int stiff_tilts(double threshold) const;
};

/// Stiffness of every contact of the packing, in their order, from the whole double-double state; parallel. The second
/// term is computed separately and never as a difference: near jamming it is 1e-16 of the first one for flat contacts.
std::vector<PairStiffness> pair_stiffnesses(const Packing& packing, std::span<const Contact> contacts);

/// The constraint number by stiffness, without a cut-off angle: each contact counts 1 plus its number of stiff tilts,
/// for both particles. C_s = (2/N) Σ_c [1 + #{k: s_k > threshold}].
double stiff_constraint_number(int particles, std::span<const PairStiffness> pairs, double threshold);

/// A row of unit length for each normal, followed by the stiff tilts of the contact: a RigidityMatrix like that of
/// class_constraints(), but from stiffness instead of classes. Throws std::invalid_argument unless `pairs` has one
/// element per contact.
RigidityMatrix stiff_constraints(const Packing& packing, std::span<const Contact> contacts,
                                 std::span<const PairStiffness> pairs, double threshold);

/// Energy of a motion u, 6N entries as in D, by origin: uᵀHu = normal + tilt + prestress, where the last two are the
/// second term. `tilt` is the contribution of stiff tilts.
struct StiffnessShares {
  double normal = 0, tilt = 0, prestress = 0;  ///< contributions to uᵀHu

  double total() const { return normal + tilt + prestress; }  ///< uᵀHu
};
/// Contributions to the energy of a motion; `pairs` has one element per contact.
StiffnessShares stiffness_shares(std::span<const Contact> contacts, std::span<const PairStiffness> pairs,
                                 double threshold, const Eigen::Ref<const Eigen::VectorXd>& u);

}  // namespace isojam
