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

/// E = Σ_pairs V²/4 (Smith, Fisher, Alam 2011, E_αβ = Y V²/4V_p) and what follows from the same overlaps; energies in
/// Y·V_p, lengths in V_p^(1/3), pressure and stress in Y.
struct Evaluation {
  double energy = 0;       ///< E, and what a load adds
  double load_energy = 0;  ///< of `energy`, what Enthalpy added
  /// 6N: per particle (−F, −T/R), lab frame; R the particle's radius of gyration. Behind them what Enthalpy adds.
  Eigen::VectorXd gradient;
  Eigen::Matrix3d stress = Eigen::Matrix3d::Zero();  ///< (1/V_cell) dE/dε, lab frame
  double pressure = 0;                               ///< −dE/dV_cell = −tr(stress)/3
  double mean_force = 0;                             ///< mean of |F| over touching pairs; 0 without contacts
  /// max over particles and both kinds of |F_i|, |T_i|/R, divided by mean_force. Infinity if mean_force is 0 and
  /// some force is not; 0 if all are.
  double residual = 0;
  /// Residual that rounding alone can make; no minimiser can be trusted below it.
  /// Working precision rounds the coordinates: λ_max·ulp(L)/mean_force, λ_max bounded by the stiffest particle.
  /// Double-double rounds the contacts: the largest Σ_c ρ_c |F_c| R_c/R of a particle over mean_force, where
  /// R_c is the circumradius, longest lever of a force, and ρ_c the relative error of V and S of a contact. Plane
  /// distances are then wrong by τ = gap_tolerance() if they exceed double_double_below(), and right to their last bits
  /// otherwise, so ρ_c = τ/max(double_double_below(), V/|S|) + τ/√|S|, the second term for the corners, whose
  /// coordinates are doubles.
  double residual_floor = 0;
  /// Energy that the same rounding can make: Σ|F|·ulp(L), and Σ ρ_c V²/2. Smaller differences mean nothing.
  double energy_noise = 0;
  long contacts = 0;  ///< touching pairs
};

/// Largest entry of stress + p·1 over p: how far the stress is from hydrostatic; 0 without pressure.
double deviator_of(const Evaluation& evaluation);

/// Second derivatives of the energy, and what they leave out.
struct SecondOrder {
  /// ∂²E/∂r², r per particle (x, R·θ) as in Evaluation::gradient; bordered by the strains ℓ·ε that are free.
  BlockMatrix hessian;
  /// Pairs that touch, and pairs that would with their gap closed; in order of (a, b, shift).
  std::vector<IncipientContact> pairs;
};

/// A touching pair. `overlap`: vector area and moment in A's body frame.
struct Contact {
  NeighbourPair pair;            ///< which particles, and the image of b
  Eigen::Vector3d displacement;  ///< x_b − x_a, the touching image, lab frame
  RelativePose pose;             ///< B in A's body frame
  Overlap overlap;               ///< V of both, and what bounds it
};

/// Terms that one contact adds to an Evaluation.
struct ContactTerms {
  Eigen::Vector3d dx, dtheta_a, dtheta_b;   ///< to the gradient: of a (of b −dx), and of rotations over R
  Eigen::Matrix3d stress;                   ///< times −V_cell
  double energy = 0, force = 0;             ///< V²/4, and |F|
  double stiffness_a = 0, stiffness_b = 0;  ///< ½ |∇V|², ∇V by the coordinates of one particle
  double error = 0;                         ///< ρ_c, see Evaluation::residual_floor
};

/// Evaluates packings. Holds caches only (neighbour list with a skin, separating axes): the same
/// packing gives the same bits whatever was evaluated before and whatever the number of threads.
class PackingEnergy {
 public:
  /// Throws std::invalid_argument unless is_legal(cell, solids.widest()).
  /// Precision::double_double computes V, S and M of every contact from the low parts of the state too, at a tenth more
  /// cost; sums are in double in either.
  Evaluation evaluate(const Packing& packing, Precision precision = Precision::working);
  /// Analytic Hessian; where two images of a particle touch another, their blocks are summed. Incipient contacts are
  /// those that touch once their centres are closer by `probe_distance` (V_p^(1/3)); with 0, the contacts alone.
  SecondOrder second_order(const Packing& packing, double probe_distance, Precision precision = Precision::working,
                           CellFreedom cell = CellFreedom::fixed);
  /// second_order() without incipient contacts.
  BlockMatrix hessian(const Packing& packing, Precision precision = Precision::working);
  /// Touching pairs in order of (a, b, shift), as exact as the state: flat contacts near jamming have no force to speak
  /// of in working precision.
  std::vector<Contact> contacts(const Packing& packing, Precision precision = Precision::double_double);

  long evaluations() const { return evaluations_; }     ///< made since this was made
  const PairCounts& counts() const { return totals_; }  ///< summed over all evaluations

 private:
  void overlap_all(const Packing& packing, Precision precision);

  NeighbourList list_;
  PlacedSolids placed_;
  TouchingPairs touching_;
  std::vector<std::vector<ContactTerms>> terms_;  ///< of touching_
  std::vector<Pose> seen_;                        ///< of the packing that touching_ belong to
  std::optional<PeriodicCell> seen_cell_;
  std::optional<Composition> seen_solids_;
  Precision seen_precision_ = Precision::working;
  long evaluations_ = 0;
  PairCounts totals_;
};

}  // namespace isojam
