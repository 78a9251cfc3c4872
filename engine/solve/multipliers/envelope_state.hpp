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

/// Evaluates envelopes of one stiffness ρ (Y·V_p^(1/3)), under the load of the cell, and counts what that takes.
class EnvelopeEvaluator {
 public:
  EnvelopeEvaluator(Enthalpy load, MinimiseWork& work) : load_(std::move(load)), work_(work) {}

  const Enthalpy& load() const { return load_; }
  /// Whether a state was asked for whose cell is not legal. Its Φ is infinite.
  bool cell_limit() const { return cell_limit_; }

  double stiffness() const { return stiffness_; }
  void set_stiffness(double value) { stiffness_ = value; }

  /// `only` as in EnvelopeEnergy::evaluate(); without the load then.
  EnvelopeState at(Packing packing, const std::vector<ContactMultiplier>& forces, const std::vector<char>& only = {});
  EnvelopeState unshifted(Packing packing);

  /// Second derivatives, those of the load included.
  BlockMatrix curvature(const EnvelopeState& state) const;

 private:
  Enthalpy load_;
  EnvelopeEnergy energy_;
  MinimiseWork& work_;
  double stiffness_ = 0;
  bool cell_limit_ = false;
};

/// ε that a step of so many particles strains the cell by.
Eigen::Matrix3d strain_of(const Eigen::VectorXd& step, int particles);
/// The step (x, R·θ) of B as A sees it, its image strained by ε.
Vector6d step_of_b(const EnvelopeContact& contact, const Eigen::VectorXd& step, const Eigen::Matrix3d& strain);

/// Forces to evaluate the state after `step`, as moved() takes it, with: multipliers as they are, shifts
/// as the step changes them to first order.
std::vector<ContactMultiplier> forces_after(const EnvelopeState& state, const Eigen::VectorXd& step);

/// Whether going from one to the other makes good the decrease that was promised. Where Φ no longer resolves it, the
/// forces decide.
bool acceptable(const EnvelopeEvaluation& from, const EnvelopeEvaluation& to, double promised);

/// The shift λ of Levenberg and Marquardt after a step, by the ratio of its actual to its promised decrease (Nielsen).
double adapted_shift(double shift, double ratio);

/// The step, cut down so that no particle moves farther than `longest`.
Eigen::VectorXd limited(const Eigen::VectorXd& step, double longest);

}  // namespace isojam
