#pragma once

#include <Eigen/Core>
#include <optional>
#include <utility>
#include <vector>

#include "engine/packing/energy.hpp"
#include "engine/solve/factor/block_cholesky.hpp"

namespace isojam {

/// The active set of a step, see StepModel: the pairs of particles that close in the step, and the pairs that tilt.
/// Both lists are sorted. They are the initial estimate for the next step.
struct ActivePairs {
  std::vector<std::pair<int, int>> closing, tilted;
};

/// The factorisation that all models of one minimisation share, and the numbers of its uses. It is shared so that its
/// symbolic part is computed only once.
struct StepFactor {
  BlockCholesky cholesky;
  long factorisations = 0;
  long updates = 0;  ///< number of linear systems that were solved by a low-rank update of a factorisation
};

/// A step (packing.hpp), and the decrease of the energy (Y·V_p) that the model predicts for it.
struct ModelStep {
  Eigen::VectorXd displacement;
  double decrease = 0;
};

/// Model of the energy for a step s: the series E + g·s + ½ s·H s, and two effects that this series does not contain.
///   1. Closing: a pair begins to touch, or a vertex contact becomes flat. The model of the overlap volume is
///      V = max(0, now, closed), where `now` and `closed` are the two tangents of IncipientContact.
///   2. Tilting: the faces of a flat contact can rotate relative to each other until the line in which their planes
///      intersect crosses the faces. From then on, the contact has a stiffness against this rotation.
/// The pairs that close or tilt in a step form its active set. The active set and the step are computed together.
/// step_model.cpp explains the terms with a sketch.
class StepModel {
 public:
  /// Largest number of linear systems that one call of minimise() solves, each by a factorisation or an update.
  static constexpr int most_rounds = 4;

  /// Makes the model of a state from its gradient and its second derivatives. Steps that would move a particle farther
  /// than `longest` (V_p^(1/3)) are shortened.
  StepModel(SecondOrder second, Eigen::VectorXd gradient, double longest);

  /// Largest diagonal entry of the Hessian: the stiffness of the stiffest coordinate.
  double largest_diagonal() const { return largest_diagonal_; }
  /// Removes effect 1, closing, from the model. The series and effect 2, tilting, remain.
  void forget_closing_pairs();
  /// Minimises the model plus ½ shift·s². `active` is at first an estimate of the active set, and on return the active
  /// set of the step. Returns nullopt if the shifted matrix is not positive definite.
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
  std::vector<State> states_;  ///< closing or tilted, for each element of second_.pairs
};

}  // namespace isojam
