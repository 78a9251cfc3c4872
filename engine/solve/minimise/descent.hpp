#pragma once

#include <Eigen/Core>
#include <optional>
#include <stop_token>

#include "engine/packing/enthalpy.hpp"
#include "engine/solve/minimise/line_search.hpp"
#include "engine/solve/minimise/minimise.hpp"

namespace isojam {

/// State of a minimisation, which all minimisers use: the current packing, the number of evaluations, and the stopping
/// criteria. Only steps to a lower energy are accepted, so the current packing is always the best one found.
class Descent {
 public:
  Descent(Packing& packing, PackingEnergy& energy, const MinimiseOptions& options, std::stop_token stop);

  const Packing& packing() const { return packing_; }
  const Evaluation& here() const { return here_; }
  const MinimiseOptions& options() const { return options_; }
  long evaluations() const { return evaluations_; }

  /// The reason to stop in the current state, or nullopt if there is none. Changes to Precision::double_double if the
  /// decision requires it.
  std::optional<StopReason> verdict();
  /// Moves along `direction` (a descent direction) by a line search that starts with the step `first_step`·direction.
  /// Returns false if no lower energy was found. last_step() is the step taken, as a multiple of `direction`.
  bool advance(const Eigen::VectorXd& direction, double first_step, double curvature);
  double last_step() const { return last_step_; }
  /// Upper limit of the displacement of a particle in one trial step (V_p^(1/3)).
  double longest_displacement() const;
  /// Computes the second derivatives of any state, and its incipient contacts within `probe_distance` (V_p^(1/3)).
  SecondOrder second_order(const Packing& packing, double probe_distance);
  /// Evaluates the state `there` that is reached from `from` by `step`, without moving the current state. If the cell
  /// of this state would be too small, returns an infinite energy; the minimisation then stops with cell_limit.
  Evaluation probe(const Packing& from, const Eigen::VectorXd& step, Packing& there);
  /// Moves the current state to a state that probe() has evaluated.
  void accept(Packing there, Evaluation value);

  /// Adds factorisations and updates of a factorisation to the summary.
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

/// Largest displacement |dx| or R|dθ| of a particle in a step. Strains ℓ·ε count as displacements.
double largest_displacement(const Eigen::VectorXd& step);

MinimiseSummary minimise_conjugate_gradient(Descent& descent);
MinimiseSummary minimise_fire(Descent& descent);
MinimiseSummary minimise_lbfgs(Descent& descent);
MinimiseSummary minimise_newton(Descent& descent);

}  // namespace isojam
