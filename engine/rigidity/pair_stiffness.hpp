#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "engine/packing/energy.hpp"
#include "engine/rigidity/rigidity_matrix.hpp"

namespace isojam {

/// Coordinates of a pair, as in PairStiffness.
using Vector12d = Eigen::Matrix<double, 12, 1>;
/// Second derivatives by these.
using Matrix12d = Eigen::Matrix<double, 12, 12>;

/// How one contact opposes motions of its two particles, r = {x_A, R_A·θ_A, x_B, R_B·θ_B}, R radii of gyration:
///   ∂²E/∂r² = ½ g gᵀ + ½ V W,  g = ∇V,  W = ∇²V  (E = V²/4)
/// The first term opposes motions that change V to first order, along its normal alone. All others are left to the
/// second: the tilts of faces and edges that lie in a face, as a matter of shape, and what the force does by turning
/// and shifting with the contact, its prestress. (A face that lies flat on a face has no tilt of its own: V is then its
/// polygon times the depth at the centroid, until the faces part within the polygon.) Of the twelve directions six move
/// the pair as a whole, one is the normal, five are left.
struct PairStiffness {
  Vector12d normal;             ///< g/|g|
  double normal_stiffness = 0;  ///< ½ |g|², Y·V_p^(1/3)
  double force = 0;             ///< f = V|S|/2, Y·V_p^(2/3)
  double length = 0;            ///< R, mean of both, V_p^(1/3)
  Matrix12d second;             ///< ½ V W
  /// Relative motions of the pair at right angles to the normal in which the second term is diagonal, orthonormal, and
  /// their stiffness κ, descending.
  Eigen::Matrix<double, 12, 5> tilts;
  Eigen::Matrix<double, 5, 1> tilt_stiffness;  ///< κ_k, Y·V_p^(1/3)
  /// Whether the second term could be had: of a pair whose loop does not close it is 0.
  bool has_second = false;

  /// Stiffness in units of what the contact's own force makes of a turn, f/R: s_k = κ_k R/f. Of order one for
  /// prestress; for an edge that lies in a face to within its depth δ, and for tilts of such faces, 1/δ and more. A
  /// contact tilted by α out of flat has s ~ δ/(R α²).
  double relative_tilt(int k) const { return tilt_stiffness[k] * length / force; }
  double relative_normal() const { return normal_stiffness * length / force; }  ///< the same of the normal
  /// Number of tilts with s above the threshold.
  int stiff_tilts(double threshold) const;
};

/// Of every contact of the packing, in their order; from the whole double-double state, parallel. The second term is
/// reckoned by itself, never as a difference: near jamming it is 1e-16 of the first in flat contacts.
std::vector<PairStiffness> pair_stiffnesses(const Packing& packing, std::span<const Contact> contacts);

/// The constraint number by stiffness, without a cut-off in angle: mean per particle of one for each contact and one
/// for each tilt that is stiff, C_s = (2/N) Σ_c [1 + #{k: s_k > threshold}] with every contact counted for both
/// particles.
double stiff_constraint_number(int particles, std::span<const PairStiffness> pairs, double threshold);

/// A row of unit length for each normal, followed by its stiff tilts: RigidityMatrix as class_constraints() makes it of
/// classes. One element of `pairs` per contact, else std::invalid_argument.
RigidityMatrix stiff_constraints(const Packing& packing, std::span<const Contact> contacts,
                                 std::span<const PairStiffness> pairs, double threshold);

/// Energy of a motion u, 6N as D has it, by what opposes it: uᵀHu = normal + tilt + prestress, and the last two are the
/// second term. Tilts are those that are stiff.
struct StiffnessShares {
  double normal = 0, tilt = 0, prestress = 0;  ///< shares of the motion's energy

  double total() const { return normal + tilt + prestress; }  ///< uᵀHu
};
/// Of a motion; one element of `pairs` per contact.
StiffnessShares stiffness_shares(std::span<const Contact> contacts, std::span<const PairStiffness> pairs,
                                 double threshold, const Eigen::Ref<const Eigen::VectorXd>& u);

}  // namespace isojam
