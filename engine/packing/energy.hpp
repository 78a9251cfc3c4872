#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "engine/packing/block_matrix.hpp"
#include "engine/packing/pair_loop.hpp"

namespace isojam {

/// E = Σ_pairs V²/4 and what follows from the same overlaps (energies in Y·V_p, lengths in V_p^(1/3)).
struct Evaluation {
  double energy = 0;
  Eigen::VectorXd gradient;  ///< 6N: per particle (−F, −T/R), lab frame; R the radius of gyration
  Eigen::Matrix3d stress = Eigen::Matrix3d::Zero();  ///< (1/V_cell) dE/dε, lab frame
  double pressure = 0;                               ///< −dE/dV_cell = −tr(stress)/3
  double mean_force = 0;                             ///< mean of |F| over touching pairs; 0 without contacts
  /// max over particles and both kinds of |F_i|, |T_i|/R, divided by mean_force. Infinity if mean_force is 0 and
  /// some force is not; 0 if all are.
  double residual = 0;
  /// The residual that rounding of the coordinates alone causes: λ_max·ulp(L)/mean_force, with λ_max bounded by the
  /// stiffest particle. No minimiser can be trusted below it in double precision.
  double residual_floor = 0;
  /// What rounding of the coordinates can do to the energy: Σ|F|·ulp(L). Smaller differences mean nothing.
  double energy_noise = 0;
  long contacts = 0;
};

/// Second derivatives of the energy, and what they leave out.
struct SecondOrder {
  BlockMatrix hessian;  ///< ∂²E/∂r², r per particle (x, R·θ) as in Evaluation::gradient
  /// The stiffness against tilt that a flat contact shows only once its section line cuts the face; until then V is
  /// linear in the tilt and the Hessian nearly blind to it. One entry per contact.
  std::vector<TiltStiffness> tilts;
};

/// A touching pair. `overlap`: area and moment in A's body frame.
struct Contact {
  NeighbourPair pair;
  Eigen::Vector3d displacement;  ///< x_b − x_a, the touching image, lab frame
  RelativePose pose;             ///< B in A's body frame
  Overlap overlap;
};

/// Evaluates packings of one solid. Holds caches only (neighbour list with a skin, separating axes): the same
/// packing gives the same bits whatever was evaluated before and whatever the number of threads.
class PackingEnergy {
 public:
  /// Throws std::invalid_argument if the cell is not larger than least_side(solid).
  Evaluation evaluate(const Packing& packing);
  /// Analytic; where two images of a particle touch another, their blocks are summed.
  SecondOrder second_order(const Packing& packing);
  BlockMatrix hessian(const Packing& packing) { return second_order(packing).hessian; }
  /// Touching pairs in order of (a, b, shift).
  std::vector<Contact> contacts(const Packing& packing);

  long evaluations() const { return evaluations_; }
  const PairCounts& counts() const { return totals_; }  ///< summed over all evaluations

 private:
  void refresh(const Packing& packing);
  void overlap_all(const Packing& packing, std::span<PairHessian> hessians);

  std::vector<NeighbourPair> pairs_;
  std::vector<SeparatingAxis> axes_;
  std::vector<PlacedSolid> placed_;
  std::vector<Overlap> overlaps_;  ///< lab frame
  std::vector<PairHessian> hessians_;
  std::vector<Eigen::Vector3d> list_positions_;
  double list_side_ = 0, skin_ = 0;
  const ConvexSolid* list_solid_ = nullptr;
  long evaluations_ = 0;
  PairCounts totals_;
};

}  // namespace isojam
