#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "engine/packing/block_matrix.hpp"
#include "engine/packing/cell/control.hpp"
#include "engine/packing/envelope/proximal_contact.hpp"
#include "engine/packing/neighbour_list.hpp"

namespace isojam {

/// Known data of a contact before its envelope is computed: its multiplier μ, and an estimate of its shift w; see
/// ProximalTerms.
struct ContactMultiplier {
  NeighbourPair pair;                      ///< the particles, and the image of b
  Vector6d multiplier = Vector6d::Zero();  ///< μ, in B's body frame
  Vector6d shift = Vector6d::Zero();       ///< w, in B's body frame
};

/// A contact of an envelope: A touches the ghost of B, or the contact has a multiplier.
struct EnvelopeContact {
  NeighbourPair pair;                                      ///< the particles, and the image of b
  Eigen::Vector3d displacement = Eigen::Vector3d::Zero();  ///< x_b − x_a for the touching image, lab frame
  Vector6d multiplier = Vector6d::Zero();                  ///< μ, in B's body frame
  ProximalContact at;                                      ///< its envelope in this state
};

/// Φ(x; μ) = Σ_contacts min_w [ e(w) + ½ ρ |w|² − μ·w ] of a packing: its energy with the stiffness of every contact
/// limited to ρ. If all shifts are 0, its value and gradient equal those of the energy.
struct EnvelopeEvaluation {
  double value = 0;                       ///< Φ, Y·V_p
  double noise = 0;                       ///< differences of Φ due to rounding
  Eigen::VectorXd gradient;               ///< 6N entries as in Evaluation::gradient; Enthalpy appends those of strains
  std::vector<EnvelopeContact> contacts;  ///< sorted by (a, b, shift)
  /// Σ (∂Φ/∂r) rᵀ over contacts, r = x_b − x_a. It replaces V_cell·stress of an Evaluation in derivatives with respect
  /// to strains.
  Eigen::Matrix3d virial = Eigen::Matrix3d::Zero();
  double mean_force = 0;        ///< mean |F| over contacts where A and the ghost touch
  double multiplier_error = 0;  ///< largest |∇e − μ| of a contact
  long touching = 0;            ///< number of contacts where A touches the ghost
  long overlaps = 0;            ///< number of overlaps with Hessian for finding the shifts
};

/// Evaluates envelopes of packings. Holds only caches, like PackingEnergy.
class EnvelopeEnergy {
 public:
  /// `forces` must be sorted by (a, b, shift); for other pairs μ = 0. `only` has one flag per particle: contacts
  /// without a flagged particle are skipped. Throws std::invalid_argument unless is_legal(cell, solids.widest()).
  EnvelopeEvaluation evaluate(const Packing& packing, std::span<const ContactMultiplier> forces, double stiffness,
                              std::span<const char> only = {});
  /// The touching pairs in their present state, each with the multiplier ∇e, so that all shifts are 0 and Φ = E.
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
  std::vector<Pose> poses_;  ///< poses for which placed_ is valid
};

/// The result that evaluate() with `only` would give, taken from a full evaluation: the contacts of flagged particles.
EnvelopeEvaluation part_of(const EnvelopeEvaluation& whole, std::span<const char> only);

/// The full evaluation of a packing in which only flagged particles have moved since `before`: their contacts come from
/// `part`, the others from `before`.
EnvelopeEvaluation with_part(const EnvelopeEvaluation& before, const EnvelopeEvaluation& part,
                             std::span<const char> only);

/// Second derivatives of Φ with respect to the particles, bordered by the free strains.
BlockMatrix curvature(const EnvelopeEvaluation& evaluation, int particles, CellFreedom cell = CellFreedom::fixed);

/// The present multipliers and shifts of all contacts.
std::vector<ContactMultiplier> forces_of(const EnvelopeEvaluation& evaluation);

}  // namespace isojam
