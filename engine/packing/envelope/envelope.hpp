#pragma once

#include <Eigen/Core>
#include <memory>
#include <span>
#include <vector>

#include "engine/packing/block_matrix.hpp"
#include "engine/packing/cell/control.hpp"
#include "engine/packing/envelope/proximal_contact.hpp"
#include "engine/packing/neighbour_list.hpp"

namespace isojam {

/// Data from which the envelope of a contact is computed. proximal_contact.hpp defines μ, w, ρ, e and the ghost.
struct ContactMultiplier {
  NeighbourPair pair;                      ///< the particles, and the image of b
  Vector6d multiplier = Vector6d::Zero();  ///< multiplier μ, in the body frame of B
  Vector6d shift = Vector6d::Zero();       ///< estimate of the shift w, in the body frame of B
  bool plain = false;  ///< true if the contact is much softer than ρ, so that its energy replaces its envelope
};

/// Parameters of an envelope that are the same for all contacts; see ProximalTerms.
struct EnvelopeTerms {
  double stiffness = 0;     ///< ρ, in units of Y·V_p^(1/3)
  double series_below = 0;  ///< residual below which the last Newton step for w is taken by a series
};

/// A pair of particles in an envelope. A touches the ghost of B, or the multiplier of the pair is not 0.
struct EnvelopeContact {
  NeighbourPair pair;                                      ///< the particles, and the image of b
  Eigen::Vector3d displacement = Eigen::Vector3d::Zero();  ///< displacement from a to the image of b, lab frame
  Vector6d multiplier = Vector6d::Zero();                  ///< multiplier μ, in the body frame of B
  std::shared_ptr<const ProximalContact> at;  ///< envelope of this pair in the present state, shared by copies
};

/// Envelope of a packing, Φ = Σ_pairs min_w [ e(w) + ½ ρ |w|² − μ·w ], as a function of the coordinates of the
/// particles. It is a modified energy in which the stiffness of every contact is at most ρ. If all shifts w are 0, its
/// value and gradient are equal to the value and gradient of the energy.
struct EnvelopeEvaluation {
  double value = 0;  ///< Φ, in units of Y·V_p
  double noise = 0;  ///< error of Φ that rounding can cause, in the same units
  /// gradient with 6N entries, as in Evaluation::gradient; Enthalpy::of() appends the derivatives with respect to
  /// strains
  Eigen::VectorXd gradient;
  std::vector<EnvelopeContact> contacts;  ///< sorted by canonical_key() of their pairs (neighbours.hpp)
  /// Virial Σ (∂Φ/∂r) rᵀ over all contacts, with r = x_b − x_a. It corresponds to V_cell·stress of an Evaluation.
  Eigen::Matrix3d virial = Eigen::Matrix3d::Zero();
  double mean_force = 0;        ///< mean contact force |F| over the pairs in which A touches the ghost of B
  double multiplier_error = 0;  ///< largest |∇e − μ| of all contacts
  long touching = 0;            ///< number of pairs in which A touches the ghost of B
  long overlaps = 0;            ///< number of overlaps with Hessian that were computed to find the shifts
};

/// Computes envelopes of packings. An object contains only caches, which never change a result.
class EnvelopeEnergy {
 public:
  /// Computes the envelope. `forces` contains the multipliers, sorted by canonical_key() of their pairs. Pairs that are
  /// not in it have μ = 0. If `only` is not empty, it has one flag per particle, and pairs without a flagged particle
  /// are skipped. Throws std::invalid_argument if the cell is not legal for the particles (is_legal() in
  /// cell/periodic_cell.hpp).
  EnvelopeEvaluation evaluate(const Packing& packing, std::span<const ContactMultiplier> forces,
                              const EnvelopeTerms& terms, std::span<const char> only = {});
  /// Computes the envelope for the multipliers μ = ∇e. With these multipliers all shifts are 0 and Φ = E.
  EnvelopeEvaluation unshifted(const Packing& packing, double stiffness);

 private:
  void place(const Packing& packing);
  std::vector<std::size_t> near_pairs(const Packing& packing, const std::vector<const ContactMultiplier*>& force_of,
                                      std::span<const char> only);
  template <class Find>
  EnvelopeEvaluation evaluate_pairs(const Packing& packing, const std::vector<std::size_t>& near, const Find& find);

  NeighbourList list_;
  PlacedSolids placed_;
  std::optional<Composition> solids_;
  std::vector<Pose> poses_;  ///< poses from which placed_ was computed
};

/// The part of `whole` that the pairs with a flagged particle contribute. `whole` must be an evaluation of all pairs.
/// The result is the same as that of evaluate() with the flags `only`, apart from `overlaps`.
EnvelopeEvaluation part_of(const EnvelopeEvaluation& whole, std::span<const char> only);

/// The evaluation of all pairs of a packing in which only flagged particles have moved since the evaluation `before`.
/// Pairs with a flagged particle are taken from `part`, the new evaluation with the flags `only`. All other pairs are
/// taken from `before`.
EnvelopeEvaluation with_part(const EnvelopeEvaluation& before, const EnvelopeEvaluation& part,
                             std::span<const char> only);

/// Second derivatives of Φ with respect to the coordinates of the particles, with a border for the free strains.
BlockMatrix curvature(const EnvelopeEvaluation& evaluation, int particles, CellFreedom cell = CellFreedom::fixed);

/// Sets `plain` for the contacts of `evaluation` whose stiffness is below `limit`. `forces` must be forces_of() of the
/// same evaluation.
void mark_soft(const EnvelopeEvaluation& evaluation, double limit, std::vector<ContactMultiplier>& forces);

/// The multipliers and shifts of all pairs in the evaluation.
std::vector<ContactMultiplier> forces_of(const EnvelopeEvaluation& evaluation);

}  // namespace isojam
