#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "engine/packing/block_matrix.hpp"
#include "engine/packing/cell/control.hpp"
#include "engine/packing/envelope/proximal_contact.hpp"
#include "engine/packing/neighbour_list.hpp"

namespace isojam {

/// What is known of a contact before its envelope is: its multiplier μ, and a guess of its shift w; see ProximalTerms.
struct ContactMultiplier {
  NeighbourPair pair;                      ///< which particles, and the image of b
  Vector6d multiplier = Vector6d::Zero();  ///< μ, in B's body frame
  Vector6d shift = Vector6d::Zero();       ///< w, in B's body frame
};

/// A contact of an envelope: A touches the ghost of B, or the contact has a multiplier.
struct EnvelopeContact {
  NeighbourPair pair;                                      ///< which particles, and the image of b
  Eigen::Vector3d displacement = Eigen::Vector3d::Zero();  ///< x_b − x_a, the touching image, lab frame
  Vector6d multiplier = Vector6d::Zero();                  ///< μ, in B's body frame
  ProximalContact at;                                      ///< its envelope there
};

/// Φ(x; μ) = Σ_contacts min_w [ e(w) + ½ ρ |w|² − μ·w ] of a packing: its energy with every contact no stiffer than ρ.
/// Where no contact is shifted its value and gradient are those of the energy.
struct EnvelopeEvaluation {
  double value = 0;                       ///< Φ, Y·V_p
  double noise = 0;                       ///< differences of Φ that rounding makes
  Eigen::VectorXd gradient;               ///< 6N, as Evaluation::gradient; behind them what a load adds
  std::vector<EnvelopeContact> contacts;  ///< in order of (a, b, shift)
  /// Σ (∂Φ/∂r) rᵀ over contacts, r = x_b − x_a: what the free strains feel, as V_cell·stress of an Evaluation.
  Eigen::Matrix3d virial = Eigen::Matrix3d::Zero();
  double mean_force = 0;        ///< mean |F| where A and the ghost touch
  double multiplier_error = 0;  ///< largest |∇e − μ| of a contact
  long touching = 0;            ///< contacts whose A touches the ghost
  long overlaps = 0;            ///< with Hessian, that finding the shifts took
};

/// Evaluates envelopes of packings. Holds caches only, as PackingEnergy does.
class EnvelopeEnergy {
 public:
  /// `forces` in order of (a, b, shift); pairs without one have μ = 0. With `only`, one flag for each particle,
  /// contacts without a flagged particle are left out. Throws std::invalid_argument unless
  /// is_legal(cell, solids.widest()).
  EnvelopeEvaluation evaluate(const Packing& packing, std::span<const ContactMultiplier> forces, double stiffness,
                              std::span<const char> only = {});
  /// The touching pairs as they are, each with the multiplier ∇e: no contact is shifted and Φ = E.
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
  std::vector<Pose> poses_;  ///< that placed_ were made of
};

/// What evaluate() with `only` gives of a packing that has been evaluated whole: the contacts of flagged particles.
EnvelopeEvaluation part_of(const EnvelopeEvaluation& whole, std::span<const char> only);

/// The evaluation of a packing of which none but flagged particles have moved since `before`: their contacts from
/// `part`, the others as they were.
EnvelopeEvaluation with_part(const EnvelopeEvaluation& before, const EnvelopeEvaluation& part,
                             std::span<const char> only);

/// Second derivatives of Φ of so many particles, bordered by the strains that are free.
BlockMatrix curvature(const EnvelopeEvaluation& evaluation, int particles, CellFreedom cell = CellFreedom::fixed);

/// Multipliers and shifts of the contacts as they are.
std::vector<ContactMultiplier> forces_of(const EnvelopeEvaluation& evaluation);

}  // namespace isojam
