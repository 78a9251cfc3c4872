#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "engine/packing/block_matrix.hpp"
#include "engine/packing/cell/control.hpp"
#include "engine/packing/cohesion_energy.hpp"
#include "engine/packing/contact_terms.hpp"
#include "engine/packing/incipient_contact.hpp"
#include "engine/packing/overlap_cache.hpp"

namespace isojam {

/// Energy of a packing, E = Σ_pairs V²/4 (Smith, Fisher, Alam 2011, E_αβ = Y V²/(4 V_p)), and its derivatives. With
/// cohesion, E = Σ_pairs V²/4 − w V_h, see Cohesion. Units: energies in Y·V_p, lengths in V_p^(1/3), pressure and
/// stress in Y.
struct Evaluation {
  double energy = 0;       ///< E + load_energy
  double load_energy = 0;  ///< energy of the load on the cell; 0 unless Enthalpy::of() has added it
  /// Gradient with 6N entries: for each particle (−F, −T/R) in the lab frame, where F is the force, T the torque and R
  /// the radius of gyration. Enthalpy::of() appends the derivatives with respect to the free strains.
  Eigen::VectorXd gradient;
  Eigen::Matrix3d stress = Eigen::Matrix3d::Zero();  ///< (1/V_cell) dE/dε, lab frame
  double pressure = 0;                               ///< −dE/dV_cell = −tr(stress)/3
  /// With cohesion, the pressure of the terms V²/4 alone, which is the scale of stresses if the total pressure is 0;
  /// nullopt without cohesion.
  std::optional<double> repulsive_pressure = std::nullopt;
  /// mean of the contact force |F| over all touching pairs, without cohesion; 0 without contacts
  double mean_force = 0;
  /// Largest value of |F_i| and |T_i|/R over all particles i, divided by mean_force, where F_i is the net force and T_i
  /// the net torque on a particle. It is 0 if all F_i and T_i are 0, and infinite if only mean_force is 0.
  /// Enthalpy::of() also takes the stress into account.
  double residual = 0;
  /// Residual that rounding errors alone can cause, so a minimisation ends when the residual is at most this value.
  /// - Precision::working: the coordinates are rounded, and the floor is λ·ulp(L)/mean_force, where L is the side of
  ///   the cell, ulp(L) = 2⁻⁵² L, and λ = 2 max Σ_c ½ |∇V|² an estimate of the largest eigenvalue of the Hessian. The
  ///   sum is over the contacts c of a particle, and the maximum over all particles.
  /// - Precision::double_double: V and S of the contacts have rounding errors, and the floor is
  ///   b·max Σ_c ρ_c |F_c|/mean_force, with the same sum and maximum. The factor b is the largest ratio of circumradius
  ///   to radius of gyration, because the circumradius is the longest lever arm of a force.
  ///   ρ_c = τ/max(d, V/|S|) + τ/√|S| is the relative error of the volume V and the vector area S of a contact. Its
  ///   first term is due to the distances of vertices from planes: those above d = double_double_below() have the error
  ///   τ = gap_tolerance(), and smaller ones are correct to their last bits. The second term is due to the corners of
  ///   the intersection, whose coordinates are doubles.
  double residual_floor = 0;
  /// Error of the energy that the same rounding can cause, as a sum over contacts: Σ |F|·ulp(L) with
  /// Precision::working, and Σ ρ_c V²/2 with Precision::double_double.
  double energy_noise = 0;
  long contacts = 0;  ///< number of touching pairs
};

/// Deviation from hydrostatic stress: the largest absolute value of the entries of stress + p·1, divided by p, or with
/// cohesion by repulsive_pressure. It is 0 if the divisor is not positive.
double deviator_of(const Evaluation& evaluation);

/// Second derivatives of the energy, and the incipient contacts (incipient_contact.hpp), because the second derivatives
/// contain too little of the stiffness of some of them.
struct SecondOrder {
  /// Hessian ∂²E/∂r². The coordinates r are (x, R·θ) for each particle, as in Evaluation::gradient, followed by the
  /// coordinates ℓ·ε of the free strains, with ℓ = strain_length() (cell/control.hpp).
  BlockMatrix hessian;
  /// Pairs that touch, and pairs that would touch if their centres were closer by the probe distance. They are sorted
  /// by (a, b, shift), see NeighbourPair.
  std::vector<IncipientContact> pairs;
};

/// A contact: two particles A and B that touch. The vector area and the moment of `overlap` are in the body frame of A.
struct Contact {
  NeighbourPair pair;            ///< the particles a and b, and the image of b
  Eigen::Vector3d displacement;  ///< displacement from a to the touching image of b, lab frame
  RelativePose pose;             ///< pose of B in the body frame of A
  Overlap overlap;               ///< volume V of the intersection, and the faces and edges that bound it
};

/// Computes energies, forces, Hessians and contacts of packings. An object contains only caches, such as a neighbour
/// list, and counters, so the result for a packing does not depend on earlier evaluations. It has the same bits for any
/// number of threads.
class PackingEnergy {
 public:
  PackingEnergy() = default;
  /// With cohesion.
  explicit PackingEnergy(const Cohesion& cohesion) : cohesion_(cohesion) {}

  /// True if the cell of the packing is legal for the particles, or with cohesion for the grown particles, see
  /// is_legal() in cell/periodic_cell.hpp.
  bool accepts(const Packing& packing);
  /// Computes the energy and its first derivatives. Throws std::invalid_argument if the cell is not legal for the
  /// particles (is_legal() in cell/periodic_cell.hpp). With Precision::double_double, the volume, vector area and
  /// moment of every contact are computed in double-double, but the sums over contacts in double.
  Evaluation evaluate(const Packing& packing, Precision precision = Precision::working);
  /// Computes the Hessian from analytic formulae, and the incipient contacts for a probe distance, in units of
  /// V_p^(1/3). With the probe distance 0, these are the pairs that touch. The last rows and columns of the Hessian
  /// belong to the free strains of `cell`.
  SecondOrder second_order(const Packing& packing, double probe_distance, Precision precision = Precision::working,
                           CellFreedom cell = CellFreedom::fixed);
  /// Computes only the Hessian of second_order(), without strains.
  BlockMatrix hessian(const Packing& packing, Precision precision = Precision::working);
  /// Finds all contacts, sorted by (a, b, shift), see NeighbourPair. The default is Precision::double_double, because
  /// Precision::working does not resolve the force of face-face contacts near jamming.
  std::vector<Contact> contacts(const Packing& packing, Precision precision = Precision::double_double);

  long evaluations() const { return evaluations_; }     ///< number of calls of evaluate()
  const PairCounts& counts() const { return totals_; }  ///< sums over all pair loops of this object

 private:
  OverlapCache overlaps_;
  PairTerms terms_;
  std::optional<CohesionEnergy> cohesion_;
  long evaluations_ = 0;
  PairCounts totals_;
};

}  // namespace isojam
