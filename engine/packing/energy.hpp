#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "engine/packing/block_matrix.hpp"
#include "engine/packing/cell/control.hpp"
#include "engine/packing/incipient_contact.hpp"
#include "engine/packing/neighbour_list.hpp"
#include "engine/packing/pair_loop.hpp"

namespace isojam {

/// Energy of a packing, E = Σ_pairs V²/4 (Smith, Fisher, Alam 2011, E_αβ = Y V²/4V_p), and its derivatives, computed
/// from the same overlaps. Units: energies in Y·V_p, lengths in V_p^(1/3), pressure and stress in Y.
struct Evaluation {
  double energy = 0;       ///< E, plus load_energy
  double load_energy = 0;  ///< energy of the load on the cell, which Enthalpy adds to `energy`
  /// Gradient with 6N entries: for each particle (−F, −T/R) in the lab frame, where F is the force, T the torque and R
  /// the radius of gyration. Enthalpy appends the derivatives with respect to the free strains.
  Eigen::VectorXd gradient;
  Eigen::Matrix3d stress = Eigen::Matrix3d::Zero();  ///< (1/V_cell) dE/dε, lab frame
  double pressure = 0;                               ///< −dE/dV_cell = −tr(stress)/3
  double mean_force = 0;  ///< mean of the contact force |F| over all touching pairs; 0 without contacts
  /// Largest net force |F_i| or torque |T_i|/R of all particles, divided by mean_force. It is 0 if all of these are 0,
  /// and infinite if mean_force is 0 but some net force or torque is not.
  double residual = 0;
  /// Residual that rounding errors alone can cause. No minimiser can reach a smaller residual. Precision::working
  /// rounds the coordinates: λ_max·ulp(L)/mean_force, with λ_max bounded by the stiffest particle.
  /// Precision::double_double rounds the contacts: the largest Σ_c ρ_c |F_c| R_c/R of a particle divided by mean_force.
  /// R_c is the circumradius, the longest lever arm of a force, and ρ_c is the relative error of V and S of a contact.
  /// The error of a plane distance is τ = gap_tolerance() for distances above double_double_below(); smaller distances
  /// are correct to their last bits. So ρ_c = τ/max(double_double_below(), V/|S|) + τ/√|S|, where the second term is
  /// due to the corners, whose coordinates are doubles.
  double residual_floor = 0;
  /// Error of the energy that the same rounding can cause: Σ|F|·ulp(L) with Precision::working, Σ ρ_c V²/2 with
  /// Precision::double_double. Differences of energies that are smaller than this are not significant.
  double energy_noise = 0;
  long contacts = 0;  ///< number of touching pairs
};

/// Deviation from hydrostatic stress: the largest entry of stress + p·1, divided by p. It is 0 if there is no pressure.
double deviator_of(const Evaluation& evaluation);

/// Second derivatives of the energy, and the pairs of particles whose stiffness is missing or too small in these
/// derivatives.
struct SecondOrder {
  /// Hessian ∂²E/∂r². The coordinates r are (x, R·θ) for each particle, as in Evaluation::gradient, followed by the
  /// free strains ℓ·ε (the border of the matrix).
  BlockMatrix hessian;
  /// Pairs that touch, and pairs that would touch if their centres were closer by the probe distance; sorted by (a, b,
  /// shift).
  std::vector<IncipientContact> pairs;
};

/// A contact: two particles A and B that touch. The vector area and the moment of `overlap` are in the body frame of A.
struct Contact {
  NeighbourPair pair;            ///< the particles, and the image of b
  Eigen::Vector3d displacement;  ///< x_b − x_a for the touching image, lab frame
  RelativePose pose;             ///< pose of B in the body frame of A
  Overlap overlap;               ///< volume V of the intersection, and the faces and edges that bound it
};

/// Contributions of one contact to an Evaluation.
struct ContactTerms {
  /// to the gradient: dx for a and −dx for b, and dtheta (torque divided by R) for a and b
  Eigen::Vector3d dx, dtheta_a, dtheta_b;
  Eigen::Matrix3d stress;        ///< to the stress, multiplied by −V_cell
  double energy = 0, force = 0;  ///< energy V²/4, and contact force |F|
  /// ½ |∇V|², where ∇V contains the derivatives with respect to the coordinates of only a or only b
  double stiffness_a = 0, stiffness_b = 0;
  double error = 0;  ///< relative error ρ_c, see Evaluation::residual_floor
};

/// Computes energies, forces, Hessians and contacts of packings. An object contains only caches: a neighbour list and
/// separating axes. The same packing therefore gives the same bits, for any earlier evaluations and for any number of
/// threads.
class PackingEnergy {
 public:
  /// Computes the energy and its first derivatives. Throws std::invalid_argument unless is_legal(cell, solids.widest())
  /// is true. With Precision::double_double, V, S and M of every contact are computed from both doubles of each
  /// coordinate, which costs a tenth more. With both precisions, sums over contacts are computed in double.
  Evaluation evaluate(const Packing& packing, Precision precision = Precision::working);
  /// Computes the analytic Hessian and the incipient contacts. Incipient contacts are pairs that touch if their centres
  /// are closer by `probe_distance` (V_p^(1/3)); with 0, these are only the contacts. If two images of a particle touch
  /// the same particle, the blocks of both are added.
  SecondOrder second_order(const Packing& packing, double probe_distance, Precision precision = Precision::working,
                           CellFreedom cell = CellFreedom::fixed);
  /// Computes only the Hessian of second_order().
  BlockMatrix hessian(const Packing& packing, Precision precision = Precision::working);
  /// Finds all contacts, sorted by (a, b, shift). The default is Precision::double_double, because near jamming
  /// Precision::working does not resolve the force of flat contacts.
  std::vector<Contact> contacts(const Packing& packing, Precision precision = Precision::double_double);

  long evaluations() const { return evaluations_; }     ///< number of evaluations that this object has made
  const PairCounts& counts() const { return totals_; }  ///< sums over all evaluations of this object

 private:
  void overlap_all(const Packing& packing, Precision precision);

  NeighbourList list_;
  PlacedSolids placed_;
  TouchingPairs touching_;
  std::vector<std::vector<ContactTerms>> terms_;  ///< terms of touching_
  std::vector<Pose> evaluated_poses_;             ///< poses of the packing to which touching_ belongs
  std::optional<PeriodicCell> evaluated_cell_;
  std::optional<Composition> evaluated_solids_;
  Precision evaluated_precision_ = Precision::working;
  long evaluations_ = 0;
  PairCounts totals_;
};

}  // namespace isojam
