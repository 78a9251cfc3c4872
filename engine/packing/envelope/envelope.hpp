#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "engine/packing/block_matrix.hpp"
#include "engine/packing/cell/control.hpp"
#include "engine/packing/envelope/proximal_contact.hpp"
#include "engine/packing/neighbour_list.hpp"

namespace isojam {

/// Data of a contact from which its envelope is computed: its multiplier μ, and an estimate of its shift w.
/// proximal_contact.hpp defines these terms.
struct ContactMultiplier {
  NeighbourPair pair;                      ///< the particles, and the image of b
  Vector6d multiplier = Vector6d::Zero();  ///< multiplier μ, in the body frame of B
  Vector6d shift = Vector6d::Zero();       ///< estimate of the shift w, in the body frame of B
};

/// A contact of an envelope: a pair in which A touches the ghost of B, or which has a multiplier.
struct EnvelopeContact {
  NeighbourPair pair;                                      ///< the particles, and the image of b
  Eigen::Vector3d displacement = Eigen::Vector3d::Zero();  ///< x_b − x_a for the touching image, lab frame
  Vector6d multiplier = Vector6d::Zero();                  ///< multiplier μ, in the body frame of B
  ProximalContact at;                                      ///< envelope of the contact in this state
};

/// Envelope of a packing, Φ(x; μ) = Σ_contacts min_w [ e(w) + ½ ρ |w|² − μ·w ]. It is a modified energy in which the
/// stiffness of every contact is at most ρ. If all shifts w are 0, its value and gradient are equal to those of the
/// energy.
struct EnvelopeEvaluation {
  double value = 0;  ///< value Φ, in units of Y·V_p
  double noise = 0;  ///< error of Φ that rounding can cause
  /// gradient with 6N entries, as in Evaluation::gradient; Enthalpy appends the derivatives with respect to strains
  Eigen::VectorXd gradient;
  std::vector<EnvelopeContact> contacts;  ///< sorted by (a, b, shift)
  /// Virial Σ (∂Φ/∂r) rᵀ over all contacts, r = x_b − x_a. For the derivatives with respect to strains, it replaces
  /// V_cell·stress of an Evaluation.
  Eigen::Matrix3d virial = Eigen::Matrix3d::Zero();
  double mean_force = 0;        ///< mean |F| over the contacts in which A touches the ghost of B
  double multiplier_error = 0;  ///< largest |∇e − μ| of all contacts
  long touching = 0;            ///< number of contacts in which A touches the ghost of B
  long overlaps = 0;            ///< number of overlaps with Hessian that were computed to find the shifts
};

/// Computes envelopes of packings. Like PackingEnergy, an object contains only caches.
class EnvelopeEnergy {
 public:
  /// Computes the envelope. `forces` must be sorted by (a, b, shift); pairs that are not in it have μ = 0. If `only` is
  /// given, it has one flag per particle, and contacts without a flagged particle are skipped. Throws
  /// std::invalid_argument unless is_legal(cell, solids.widest()) is true.
  EnvelopeEvaluation evaluate(const Packing& packing, std::span<const ContactMultiplier> forces, double stiffness,
                              std::span<const char> only = {});
  /// The contacts of a packing with the multipliers ∇e. With these multipliers all shifts are 0 and Φ = E.
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

/// The part of a full evaluation that evaluate() with `only` would compute: the contacts of flagged particles.
EnvelopeEvaluation part_of(const EnvelopeEvaluation& whole, std::span<const char> only);

/// The full evaluation of a packing in which only flagged particles have moved since the evaluation `before`. The
/// contacts of flagged particles are taken from `part`, and all other contacts from `before`.
EnvelopeEvaluation with_part(const EnvelopeEvaluation& before, const EnvelopeEvaluation& part,
                             std::span<const char> only);

/// Second derivatives of Φ with respect to the particles, with a border for the free strains.
BlockMatrix curvature(const EnvelopeEvaluation& evaluation, int particles, CellFreedom cell = CellFreedom::fixed);

/// The multipliers and shifts of all contacts in this evaluation.
std::vector<ContactMultiplier> forces_of(const EnvelopeEvaluation& evaluation);

}  // namespace isojam
