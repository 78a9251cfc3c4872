#pragma once

#include <Eigen/Core>
#include <optional>
#include <utility>
#include <vector>

#include "engine/packing/energy.hpp"
#include "engine/solve/factor/block_cholesky.hpp"

namespace isojam {

/// Sorted pairs of particles that a step is predicted to close or to tilt; the initial estimate for the next model.
struct ActivePairs {
  std::vector<std::pair<int, int>> closing, tilted;
};

/// The factor shared by all models of one minimisation, which reuses its symbolic part, and counts of its use.
struct StepFactor {
  BlockCholesky cholesky;
  long factorisations = 0;
  long updates = 0;  ///< systems solved by a low-rank update instead
};

/// A step s in the form of moved(), and the decrease in energy (Y·V_p) that the model predicts for it.
struct ModelStep {
  Eigen::VectorXd displacement;
  double decrease = 0;
};

/// Model of the energy for a step s: E + g·s + ½ s·H s, and two effects that occur before this series fails. Pairs
/// close: V = max(0, now, closed), the tangents of an incipient contact. Flat contacts tilt until their section line
/// crosses the face: they get a stiffness against tilt. The pairs affected, the active set, are determined together
/// with the step. step_model.cpp explains the terms, with a sketch.
class StepModel {
 public:
  /// Maximum number of systems that one minimise() solves, each by a factorisation or an update.
  static constexpr int most_rounds = 4;

  /// Model at the state with `gradient`. Steps that move a particle farther than `longest` (V_p^(1/3)) are scaled down.
  StepModel(SecondOrder second, Eigen::VectorXd gradient, double longest);

  /// Largest diagonal entry of the Hessian: the spring constant of the stiffest coordinate.
  double largest_diagonal() const { return largest_diagonal_; }
  /// Keeps only the present contacts: E + g·s + ½ s·H s, and tilt.
  void forget_closing_pairs();
  /// Minimises the model plus ½ shift·s². `active` is the initial estimate, then the result. Returns nullopt if the
  /// shifted matrix is not positive definite.
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
  std::vector<State> states_;  ///< states of second_.pairs
};

}  // namespace isojam
