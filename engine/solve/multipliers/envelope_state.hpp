#pragma once

#include <Eigen/Core>
#include <utility>
#include <vector>

#include "engine/packing/enthalpy.hpp"
#include "engine/packing/envelope/envelope.hpp"
#include "engine/packing/packing.hpp"
#include "engine/solve/minimise/summary.hpp"

namespace isojam {

/// A packing and the evaluation of its envelope Φ (packing/envelope/envelope.hpp). For ρ, μ, e and the shifts w, see
/// packing/envelope/proximal_contact.hpp.
struct EnvelopeState {
  Packing packing;
  EnvelopeEvaluation value;
};

/// Evaluates envelopes with one stiffness ρ (Y·V_p^(1/3)), adds the load on the cell, and counts the operations.
class EnvelopeEvaluator {
 public:
  EnvelopeEvaluator(Enthalpy load, MinimiseWork& work) : load_(std::move(load)), work_(work) {}

  const Enthalpy& load() const { return load_; }
  /// True if the cell of a requested state was not legal (is_legal() in packing/cell/periodic_cell.hpp). Φ of such a
  /// state is infinite.
  bool cell_limit() const { return cell_limit_; }

  void set_stiffness(double value) { terms_.stiffness = value; }
  /// See ProximalTerms::series_below. At 0, all contacts are computed to full accuracy.
  void set_series_below(double value) { terms_.series_below = value; }

  /// Evaluates the envelope with the multipliers `forces`. If `only` is not empty, only contacts of the flagged
  /// particles are included, and the load is not.
  EnvelopeState at(Packing packing, const std::vector<ContactMultiplier>& forces, const std::vector<char>& only = {});
  /// Evaluates the envelope with the multipliers μ = ∇e, for which all shifts are 0.
  EnvelopeState unshifted(Packing packing);

  /// Second derivatives of Φ, including the second derivatives of the load.
  BlockMatrix curvature(const EnvelopeState& state) const;

 private:
  Enthalpy load_;
  EnvelopeEnergy energy_;
  MinimiseWork& work_;
  EnvelopeTerms terms_;
  bool cell_limit_ = false;
};

/// The strain ε of the cell in a step (packing.hpp). `particles` is N.
Eigen::Matrix3d strain_of(const Eigen::VectorXd& step, int particles);
/// The step (x, R·θ) of B in a contact, including the motion of its image relative to A due to the strain ε.
Vector6d step_of_b(const EnvelopeContact& contact, const Eigen::VectorXd& step, const Eigen::Matrix3d& strain);

/// Multipliers and shifts w after a step (packing.hpp). The multipliers do not change. The shifts are estimated to
/// first order in the step.
std::vector<ContactMultiplier> forces_after(const EnvelopeState& state, const Eigen::VectorXd& step);

/// True if the decrease of Φ from `from` to `to` is large enough compared with the predicted decrease. If the predicted
/// decrease is not larger than the rounding errors of Φ, the gradients in both states are compared instead.
bool acceptable(const EnvelopeEvaluation& from, const EnvelopeEvaluation& to, double predicted_decrease);

/// The Levenberg–Marquardt shift for the next step, from the shift of this step and the ratio of the actual decrease to
/// the predicted decrease (Nielsen's rule).
double adapted_shift(double shift, double ratio);

/// The step, multiplied by a factor of at most 1, so that no particle moves farther than `longest`.
Eigen::VectorXd limited(const Eigen::VectorXd& step, double longest);

}  // namespace isojam
