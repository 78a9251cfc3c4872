#pragma once

#include <Eigen/Core>
#include <optional>
#include <utility>
#include <vector>

#include "engine/packing/energy.hpp"
#include "engine/solve/factor/block_cholesky.hpp"

namespace isojam {

/// Pairs of particles that a step was expected to close or to tilt, sorted: the first guess for the next model.
struct ActivePairs {
  std::vector<std::pair<int, int>> closing, tilted;
};

/// The factor that models of one minimisation share, for its symbolic part, and how often it was put to use.
struct StepFactor {
  BlockCholesky cholesky;
  long factorisations = 0;
  long updates = 0;  ///< solved by low-rank update instead
};

/// A step s as moved() takes it, and the decrease in energy (Y·V_p) that the model promises for it.
struct ModelStep {
  Eigen::VectorXd displacement;
  double decrease = 0;
};

/// Model of the energy over a step s: E + g·s + ½ s·H s, and two things that happen before that series ends. Pairs
/// close: V = max(0, now, closed), the tangents of an incipient contact. Flat contacts tilt until their section line
/// cuts the face: they have a stiffness against tilt. Which pairs do either, the active set, is found with the step.
/// The notions are explained, with a sketch, in step_model.cpp.
class StepModel {
 public:
  /// Systems that one minimise() solves at most, each by a factorisation or an update of one: what it may cost.
  static constexpr int most_rounds = 4;

  /// Model at the state with `gradient`; steps in which a particle moves farther than `longest` (V_p^(1/3)) are cut
  /// down.
  StepModel(SecondOrder second, Eigen::VectorXd gradient, double longest);

  /// Largest diagonal entry of the Hessian, the spring constant of the stiffest coordinate.
  double largest_diagonal() const { return largest_diagonal_; }
  /// Keeps the present contacts only: plain E + g·s + ½ s·H s, and tilt.
  void forget_closing_pairs();
  /// Minimises the model plus ½ shift·s². `active`: first guess, then what was found. nullopt if the shifted matrix is
  /// not positive definite.
  std::optional<ModelStep> minimise(double shift, StepFactor& factor, ActivePairs& active);

 private:
  struct State {
    bool closing = false, tilted = false;
  };

  void recall(const ActivePairs& active, double shift);
  ActivePairs active_pairs(const Eigen::VectorXd& step) const;
  bool may_close(const IncipientContact& pair, double shift) const;
  bool revise(const Eigen::VectorXd& step, double shift, bool may_release);
  double tilt_weight(const IncipientContact& pair, const State& state, double shift) const;
  BlockMatrix assembled(double shift) const;
  std::optional<Eigen::MatrixXd> gained(const std::vector<State>& before, double shift) const;
  Eigen::VectorXd column(const IncipientContact& pair, const LinearisedOverlap& volume) const;
  Eigen::VectorXd gradient() const;
  double decrease(const Eigen::VectorXd& step) const;

  SecondOrder second_;
  Eigen::VectorXd gradient_;
  double longest_, largest_diagonal_ = 0;
  std::vector<State> states_;  ///< of second_.pairs
};

}  // namespace isojam
