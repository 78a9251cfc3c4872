#pragma once

#include <Eigen/Core>
#include <utility>
#include <vector>

#include "engine/packing/enthalpy.hpp"
#include "engine/packing/envelope/envelope.hpp"
#include "engine/packing/packing.hpp"
#include "engine/solve/minimise/summary.hpp"

namespace isojam {

/// A packing and its envelope.
struct EnvelopeState {
  Packing packing;
  EnvelopeEvaluation value;
};

/// Evaluates envelopes with one stiffness ρ (Y·V_p^(1/3)) under the load of the cell, and counts the work.
class EnvelopeEvaluator {
 public:
  EnvelopeEvaluator(Enthalpy load, MinimiseWork& work) : load_(std::move(load)), work_(work) {}

  const Enthalpy& load() const { return load_; }
  /// True if a requested state had a cell that is not legal. Its Φ is infinite.
  bool cell_limit() const { return cell_limit_; }

  double stiffness() const { return stiffness_; }
  void set_stiffness(double value) { stiffness_ = value; }

  /// `only` as in EnvelopeEnergy::evaluate(); if given, the load is not included.
  EnvelopeState at(Packing packing, const std::vector<ContactMultiplier>& forces, const std::vector<char>& only = {});
  EnvelopeState unshifted(Packing packing);

  /// Second derivatives, including those of the load.
  BlockMatrix curvature(const EnvelopeState& state) const;

 private:
  Enthalpy load_;
  EnvelopeEnergy energy_;
  MinimiseWork& work_;
  double stiffness_ = 0;
  bool cell_limit_ = false;
};

/// Strain ε of the cell in a step of a packing of `particles`.
Eigen::Matrix3d strain_of(const Eigen::VectorXd& step, int particles);
/// The step (x, R·θ) of B relative to A's frame, with its image strained by ε.
Vector6d step_of_b(const EnvelopeContact& contact, const Eigen::VectorXd& step, const Eigen::Matrix3d& strain);

/// Initial values for evaluating the state after `step` (in the form of moved()): unchanged multipliers, and shifts as
/// the step changes them to first order.
std::vector<ContactMultiplier> forces_after(const EnvelopeState& state, const Eigen::VectorXd& step);

/// True if the decrease from one state to the other is sufficient compared with the predicted one. If Φ does not
/// resolve it, the forces decide.
bool acceptable(const EnvelopeEvaluation& from, const EnvelopeEvaluation& to, double promised);

/// The Levenberg–Marquardt shift λ after a step, from the ratio of its actual to its predicted decrease (Nielsen).
double adapted_shift(double shift, double ratio);

/// The step, scaled down so that no particle moves farther than `longest`.
Eigen::VectorXd limited(const Eigen::VectorXd& step, double longest);

}  // namespace isojam
