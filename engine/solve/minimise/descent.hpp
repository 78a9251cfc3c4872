#pragma once

#include <Eigen/Core>
#include <optional>
#include <stop_token>

#include "engine/packing/enthalpy.hpp"
#include "engine/solve/minimise/line_search.hpp"
#include "engine/solve/minimise/minimise.hpp"

namespace isojam {

/// State that every minimiser shares: the current state, the best one found, the number of evaluations, and the reasons
/// to stop. Only downhill steps are accepted, so the current state is the best one.
class Descent {
 public:
  Descent(Packing& packing, PackingEnergy& energy, const MinimiseOptions& options, std::stop_token stop);

  const Packing& packing() const { return packing_; }
  const Evaluation& here() const { return here_; }
  const MinimiseOptions& options() const { return options_; }
  long evaluations() const { return evaluations_; }

  /// Reason to stop in this state, if there is one. Changes to double-double if the decision needs it.
  std::optional<StopReason> verdict();
  /// Moves along `direction` (a descent direction) by a line search that starts with the step `first_step`·direction.
  /// Returns false if no lower energy was found. last_step() is the step taken, as a multiple of `direction`.
  bool advance(const Eigen::VectorXd& direction, double first_step, double curvature);
  double last_step() const { return last_step_; }
  /// Upper limit of every particle's displacement in one trial step (V_p^(1/3)).
  double longest_displacement() const;
  /// Second derivatives in any state, and its incipient contacts within `probe_distance` (V_p^(1/3)).
  SecondOrder second_order(const Packing& packing, double probe_distance);
  /// Evaluates the state after `step` from `from` without moving the current state. Returns infinite energy if the cell
  /// would be too small; the minimisation then stops with cell_limit.
  Evaluation probe(const Packing& from, const Eigen::VectorXd& step, Packing& there);
  /// Moves to a state that probe() evaluated.
  void accept(Packing there, Evaluation value);

  /// Adds the work of the solver to the summary.
  void count_factorisations(long factorisations, long updates);

  MinimiseSummary finish(StopReason reason) const;

 private:
  Evaluation evaluate(const Packing& packing);
  void raise_precision();

  Packing& packing_;
  PackingEnergy& energy_;
  const MinimiseOptions& options_;
  std::stop_token stop_;
  Enthalpy enthalpy_;
  Evaluation here_;
  double previous_energy_;
  Precision precision_ = Precision::working;
  double last_step_ = 0;
  bool cell_limit_ = false;
  long evaluations_ = 0, iterations_ = 0;
  MinimiseWork work_;
};

/// Largest particle displacement |dx| or R|dθ| in a step; strains ℓ·ε count in the same way.
double largest_displacement(const Eigen::VectorXd& step);

MinimiseSummary minimise_conjugate_gradient(Descent& descent);
MinimiseSummary minimise_fire(Descent& descent);
MinimiseSummary minimise_lbfgs(Descent& descent);
MinimiseSummary minimise_newton(Descent& descent);

}  // namespace isojam
