#pragma once

#include <Eigen/Core>
#include <vector>

#include "engine/packing/envelope/envelope.hpp"
#include "engine/packing/packing.hpp"
#include "engine/solve/minimise/summary.hpp"

namespace isojam {

/// A packing and its envelope.
struct EnvelopeState {
  Packing packing;
  EnvelopeEvaluation value;
};

/// Evaluates envelopes of one stiffness ρ (Y·V_p^(1/3)) and counts what that takes.
class EnvelopeEvaluator {
 public:
  explicit EnvelopeEvaluator(MinimiseWork& work) : work_(work) {}

  double stiffness() const { return stiffness_; }
  void set_stiffness(double value) { stiffness_ = value; }

  /// `only` as in EnvelopeEnergy::evaluate().
  EnvelopeState at(Packing packing, const std::vector<ContactForce>& forces, const std::vector<char>& only = {});
  EnvelopeState unshifted(Packing packing);

 private:
  EnvelopeEnergy energy_;
  MinimiseWork& work_;
  double stiffness_ = 0;
};

/// Forces to evaluate the state after `step` (6N entries, x and R·θ per particle) with: multipliers as they are, shifts
/// as the step changes them to first order.
std::vector<ContactForce> forces_after(const EnvelopeState& state, const Eigen::VectorXd& step);

/// Whether going from one to the other makes good the decrease that was promised. Where Φ no longer resolves it, the
/// forces decide.
bool acceptable(const EnvelopeEvaluation& from, const EnvelopeEvaluation& to, double promised);

/// The shift λ of Levenberg and Marquardt after a step, by the ratio of its actual to its promised decrease (Nielsen).
double adapted_shift(double shift, double ratio);

/// The step, cut down so that no particle moves farther than `longest`.
Eigen::VectorXd limited(const Eigen::VectorXd& step, double longest);

}  // namespace isojam
