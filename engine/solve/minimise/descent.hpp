#pragma once

#include <Eigen/Core>
#include <optional>
#include <stop_token>

#include "engine/packing/enthalpy.hpp"
#include "engine/solve/minimise/line_search.hpp"
#include "engine/solve/minimise/minimise.hpp"

namespace isojam {

/// The part of a minimisation that is the same for all minimisers: the current packing, the number of evaluations, and
/// the stopping criteria. The current packing is always the best one found, because minimisers accept only steps that
/// lower the energy or reach an equilibrium.
class Descent {
 public:
  Descent(Packing& packing, PackingEnergy& energy, const MinimiseOptions& options, std::stop_token stop);

  const Packing& packing() const { return packing_; }
  const Evaluation& here() const { return here_; }
  const MinimiseOptions& options() const { return options_; }
  long evaluations() const { return evaluations_; }

  /// The reason to stop at the current packing, or nullopt if there is none. If the residual is near the residual
  /// floor, and the floor is above the requested residual, the function first changes the precision to
  /// Precision::double_double.
  std::optional<StopReason> verdict();
  /// Moves along `direction` (a descent direction) by a line search. The first trial step is first_step·direction, and
  /// `curvature` is LineSearchOptions::curvature. Returns false, and does not move, if no lower energy was found.
  bool advance(const Eigen::VectorXd& direction, double first_step, double curvature);
  double last_step() const { return last_step_; }
  /// Upper limit of the displacement of a particle in one trial step, in units of V_p^(1/3).
  double longest_displacement() const;
  /// Computes the second derivatives and the incipient contacts (IncipientContact) of any packing. The probe distance
  /// is in units of V_p^(1/3).
  SecondOrder second_order(const Packing& packing, double probe_distance);
  /// Evaluates the packing `there`, which `step` reaches from `from`. The current packing does not change. If the new
  /// cell is not legal (is_legal() in packing/cell/periodic_cell.hpp), the result has an infinite energy, and the
  /// minimisation stops with StopReason::cell_limit.
  Evaluation probe(const Packing& from, const Eigen::VectorXd& step, Packing& there);
  /// Makes `there`, which probe() has evaluated, the current packing.
  void accept(Packing there, Evaluation value);

  /// Adds numbers of factorisations and of updates of a factorisation to the summary.
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

/// Largest displacement |dx| or R|dθ| of a particle in a step. The free strains ℓ·ε (packing.hpp) count as
/// displacements.
double largest_displacement(const Eigen::VectorXd& step);

MinimiseSummary minimise_conjugate_gradient(Descent& descent);
MinimiseSummary minimise_fire(Descent& descent);
MinimiseSummary minimise_lbfgs(Descent& descent);
MinimiseSummary minimise_newton(Descent& descent);

}  // namespace isojam
