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

/// E = Σ_pairs V²/4 (Smith, Fisher, Alam 2011, E_αβ = Y V²/4V_p), and its derivatives from the same overlaps. Energies
/// in Y·V_p, lengths in V_p^(1/3), pressure and stress in Y.
struct Evaluation {
  double energy = 0;       ///< E, plus the energy of a load
  double load_energy = 0;  ///< the part of `energy` that Enthalpy added
  /// 6N entries: per particle (−F, −T/R), lab frame, R the particle's radius of gyration. Enthalpy appends derivatives
  /// with respect to strains.
  Eigen::VectorXd gradient;
  Eigen::Matrix3d stress = Eigen::Matrix3d::Zero();  ///< (1/V_cell) dE/dε, lab frame
  double pressure = 0;                               ///< −dE/dV_cell = −tr(stress)/3
  double mean_force = 0;                             ///< mean of |F| over touching pairs; 0 without contacts
  /// Largest |F_i| or |T_i|/R of a particle, divided by mean_force. Infinite if mean_force is 0 and some force is not;
  /// 0 if all are 0.
  double residual = 0;
  /// Residual that rounding alone can cause; no minimiser can do better.
  /// Precision::working rounds the coordinates: λ_max·ulp(L)/mean_force, with λ_max bounded by the stiffest particle.
  /// Precision::double_double rounds the contacts: the largest Σ_c ρ_c |F_c| R_c/R of a particle divided by mean_force.
  /// R_c is the circumradius, the longest lever arm of a force, and ρ_c is the relative error of V and S of a contact.
  /// The error of a plane distance is τ = gap_tolerance() for distances above double_double_below(); smaller distances
  /// are correct to their last bits. So ρ_c = τ/max(double_double_below(), V/|S|) + τ/√|S|, where the second term is
  /// due to the corners, whose coordinates are doubles.
  double residual_floor = 0;
  /// Energy that the same rounding can cause: Σ|F|·ulp(L), or Σ ρ_c V²/2. Smaller differences are not significant.
  double energy_noise = 0;
  long contacts = 0;  ///< number of touching pairs
};

/// Largest entry of stress + p·1, divided by p: the deviation of the stress from hydrostatic; 0 without pressure.
double deviator_of(const Evaluation& evaluation);

/// Second derivatives of the energy, and the pairs whose contribution they miss or underestimate.
struct SecondOrder {
  /// ∂²E/∂r² with r per particle (x, R·θ) as in Evaluation::gradient, bordered by the free strains ℓ·ε.
  BlockMatrix hessian;
  /// Pairs that touch, and pairs that would touch with their gap closed, sorted by (a, b, shift).
  std::vector<IncipientContact> pairs;
};

/// A touching pair. The vector area and moment of `overlap` are in A's body frame.
struct Contact {
  NeighbourPair pair;            ///< the particles, and the image of b
  Eigen::Vector3d displacement;  ///< x_b − x_a for the touching image, lab frame
  RelativePose pose;             ///< B in A's body frame
  Overlap overlap;               ///< V of both, and the faces and edges that bound it
};

/// Contribution of one contact to an Evaluation.
struct ContactTerms {
  Eigen::Vector3d dx, dtheta_a, dtheta_b;  ///< to the gradient: forces on a (b has −dx), and torques over R
  Eigen::Matrix3d stress;                  ///< contribution to the stress, times −V_cell
  double energy = 0, force = 0;            ///< V²/4, and |F|
  double stiffness_a = 0, stiffness_b = 0;  ///< ½ |∇V|², where ∇V is with respect to the coordinates of one particle
  double error = 0;                         ///< ρ_c, see Evaluation::residual_floor
};

/// Evaluates packings. The object holds only caches (a neighbour list with a skin, separating axes): the same packing
/// gives the same bits after any earlier evaluations and for any number of threads.
class PackingEnergy {
 public:
  /// Throws std::invalid_argument unless is_legal(cell, solids.widest()). Precision::double_double also uses the low
  /// parts of the state for V, S and M of every contact, and costs a tenth more. Sums are in double in either
  /// precision.
  Evaluation evaluate(const Packing& packing, Precision precision = Precision::working);
  /// Analytic Hessian. If two images of a particle touch the same particle, their blocks are added. Incipient contacts
  /// are pairs that touch once their centres are closer by `probe_distance` (V_p^(1/3)); 0 gives only the contacts.
  SecondOrder second_order(const Packing& packing, double probe_distance, Precision precision = Precision::working,
                           CellFreedom cell = CellFreedom::fixed);
  /// second_order() without incipient contacts.
  BlockMatrix hessian(const Packing& packing, Precision precision = Precision::working);
  /// Touching pairs sorted by (a, b, shift). The default precision is that of the state: near jamming, working
  /// precision does not resolve the force of flat contacts.
  std::vector<Contact> contacts(const Packing& packing, Precision precision = Precision::double_double);

  long evaluations() const { return evaluations_; }     ///< number of evaluations by this object
  const PairCounts& counts() const { return totals_; }  ///< sums over all evaluations

 private:
  void overlap_all(const Packing& packing, Precision precision);

  NeighbourList list_;
  PlacedSolids placed_;
  TouchingPairs touching_;
  std::vector<std::vector<ContactTerms>> terms_;  ///< terms of touching_
  std::vector<Pose> seen_;                        ///< poses of the packing to which touching_ belongs
  std::optional<PeriodicCell> seen_cell_;
  std::optional<Composition> seen_solids_;
  Precision seen_precision_ = Precision::working;
  long evaluations_ = 0;
  PairCounts totals_;
};

}  // namespace isojam
