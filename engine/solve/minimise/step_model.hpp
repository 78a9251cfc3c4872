#pragma once

#include <Eigen/Core>
#include <optional>
#include <utility>
#include <vector>

#include "engine/packing/energy.hpp"
#include "engine/solve/factor/block_cholesky.hpp"

namespace isojam {

/// Pairs of particles that a step was expected to press or to tilt, sorted: the first guess for the next model.
struct ActivePairs {
  std::vector<std::pair<int, int>> pressed, tilted;
};

/// The factor that models of one minimisation share, for its symbolic part, and how often it was put to use.
struct StepFactor {
  BlockCholesky cholesky;
  long factorisations = 0;
  long updates = 0;  ///< solved by low-rank update instead
};

/// A step s of 6N entries, and the decrease in energy that the model promises for it.
struct ModelStep {
  Eigen::VectorXd displacement;
  double decrease = 0;
};

/// What is expected of the energy over a step s, beyond E + g·s + ½ s·H s: near jamming that series holds for steps no
/// longer than a flat contact is deep, 1e-10 and less. Two things happen sooner, and the model knows of both.
///   Pairs close. Where the plane of V in the pressed state predicts more overlap than the present one, V = max(0, both
///   planes), and E of the pair is V²/4 of the pressed plane.
///   Flat contacts tilt until their section line cuts the face. Where the step would tilt one so far, it is given a
///   stiffness against tilt.
/// Which pairs do either is found with the step, by turns: an active-set iteration, cut short after most_rounds.
class StepModel {
 public:
  /// Systems that one minimise() solves at most, each by a factorisation or an update of one: what it may cost.
  static constexpr int most_rounds = 4;

  /// At the state with `gradient`; lengths of `longest` and more (largest displacement of a particle) are cut down.
  StepModel(SecondOrder second, Eigen::VectorXd gradient, double longest);

  /// Largest diagonal entry of the Hessian: the stiffest coordinate.
  double stiffness() const { return stiffness_; }
  /// Leaves the present contacts only: plain E + g·s + ½ s·H s, and tilt.
  void forget_closing_pairs();
  /// Minimises the model plus ½ shift·s². `active`: first guess, then what was found. nullopt if the shifted matrix is
  /// not positive definite.
  std::optional<ModelStep> minimise(double shift, StepFactor& factor, ActivePairs& active);

 private:
  struct State {
    bool pressed = false, tilted = false;
  };

  void recall(const ActivePairs& active, double shift);
  ActivePairs active_pairs(const Eigen::VectorXd& step) const;
  bool closing(const IncipientContact& pair, double shift) const;
  bool revise(const Eigen::VectorXd& step, double shift, bool may_release);
  double tilt_weight(const IncipientContact& pair, const State& state, double shift) const;
  BlockMatrix assembled(double shift) const;
  std::optional<Eigen::MatrixXd> gained(const std::vector<State>& before, double shift) const;
  Eigen::VectorXd column(const IncipientContact& pair, const Vector6d& of_a, const Vector6d& of_b) const;
  Eigen::VectorXd gradient() const;
  double decrease(const Eigen::VectorXd& step) const;

  SecondOrder second_;
  Eigen::VectorXd gradient_;
  double longest_, stiffness_ = 0;
  std::vector<State> states_;  ///< of second_.pairs
};

}  // namespace isojam
