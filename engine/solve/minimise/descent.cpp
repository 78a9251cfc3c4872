#include "engine/solve/minimise/descent.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace isojam {

namespace {

/// Upper limit of the displacement of a particle in one trial step, in units of the inradius. In a longer step,
/// particles would touch that the model of the energy ignores.
constexpr double trust_in_inradii = 0.4;

/// Double-double is used if the residual is below this many times its floor, because rounding errors then matter.
constexpr double floors_before_refining = 10;

}  // namespace

double largest_displacement(const Eigen::VectorXd& step) {
  double largest = 0;
  for (Eigen::Index k = 0; k < step.size(); k += 3)
    largest = std::max(largest, step.segment(k, std::min<Eigen::Index>(3, step.size() - k)).norm());
  return largest;
}

Descent::Descent(Packing& packing, PackingEnergy& energy, const MinimiseOptions& options, std::stop_token stop)
    : packing_(packing),
      energy_(energy),
      options_(options),
      stop_(std::move(stop)),
      enthalpy_(options.control, packing.cell),
      here_(enthalpy_.of(energy.evaluate(packing), packing)),
      previous_energy_(std::numeric_limits<double>::infinity()),
      evaluations_(1) {}

/// Double precision is enough until the residual is near its floor. Then only double-double can decide whether the
/// requested residual is reached.
void Descent::raise_precision() {
  const bool near_floor = here_.residual <= std::max(options_.residual, floors_before_refining * here_.residual_floor);
  if (precision_ == Precision::double_double || !near_floor || here_.residual_floor <= options_.residual) return;
  precision_ = Precision::double_double;
  here_ = evaluate(packing_);
}

Evaluation Descent::evaluate(const Packing& packing) {
  ++evaluations_;
  if (precision_ == Precision::double_double) ++work_.double_double_evaluations;
  return enthalpy_.of(energy_.evaluate(packing, precision_), packing);
}

SecondOrder Descent::second_order(const Packing& packing, double probe_distance) {
  ++work_.hessians;
  SecondOrder second = energy_.second_order(packing, probe_distance, precision_, options_.control.cell);
  enthalpy_.add_to(second.hessian, packing);
  return second;
}

void Descent::count_factorisations(long factorisations, long updates) {
  work_.factorisations += factorisations;
  work_.factor_updates += updates;
}

std::optional<StopReason> Descent::verdict() {
  if (!std::isfinite(here_.energy) || !here_.gradient.allFinite()) return StopReason::not_finite;
  if (cell_limit_) return StopReason::cell_limit;
  // Under pressure a packing is always jammed. Cohesion makes the energy negative.
  const bool loaded = frees_volume(options_.control.cell) || here_.repulsive_pressure;
  if (here_.contacts == 0 && !loaded) return StopReason::unjammed;
  raise_precision();
  if (here_.residual <= options_.residual) return StopReason::residual_reached;
  if (here_.residual <= here_.residual_floor) return StopReason::precision_floor;
  if (!loaded && here_.energy < options_.unjammed_energy * packing_.size()) return StopReason::unjammed;
  const bool settled = previous_energy_ - here_.energy < options_.energy_change * here_.energy;
  if (options_.energy_change > 0 && settled) return StopReason::energy_change;
  if (stop_.stop_requested()) return StopReason::interrupted;
  if (evaluations_ >= options_.max_evaluations) return StopReason::budget;
  return std::nullopt;
}

Evaluation Descent::probe(const Packing& from, const Eigen::VectorXd& step, Packing& there) {
  there = moved(from, step);
  if (options_.control.cell != CellFreedom::fixed && !energy_.accepts(there)) {
    cell_limit_ = true;
    there = from;
    Evaluation nowhere = here_;
    nowhere.energy = std::numeric_limits<double>::infinity();
    return nowhere;
  }
  return evaluate(there);
}

void Descent::accept(Packing there, Evaluation value) {
  previous_energy_ = here_.energy;
  packing_ = std::move(there);
  here_ = std::move(value);
  ++iterations_;
}

double Descent::longest_displacement() const { return trust_in_inradii * packing_.solids.least_inradius(); }

bool Descent::advance(const Eigen::VectorXd& direction, double first_step, double curvature) {
  const double reach = largest_displacement(direction);
  const LinePoint start{0, here_.energy, here_.gradient.dot(direction)};
  if (!(start.slope < 0) || !std::isfinite(reach)) return false;
  LineSearchOptions search;
  search.curvature = curvature;
  search.noise = here_.energy_noise;
  search.longest_step = longest_displacement() / reach;

  Packing lowest = packing_, trial = packing_;
  Evaluation at_lowest, at_trial;
  double step_of_lowest = 0, step_of_trial = 0;
  const auto at = [&](double step) {
    at_trial = probe(packing_, step * direction, trial);
    step_of_trial = step;
    const LinePoint point{step, at_trial.energy, at_trial.gradient.dot(direction)};
    // The search ends at the last point or at the lowest one, or elsewhere if energies differ only by noise.
    if (step_of_lowest == 0 || point.value < at_lowest.energy) {
      lowest = trial;
      at_lowest = at_trial;
      step_of_lowest = step;
    }
    return point;
  };
  const LineSearchResult result = line_search(at, start, first_step, search);
  if (!result.found) return false;
  last_step_ = result.point.step;
  if (result.point.step == step_of_lowest) {
    accept(std::move(lowest), std::move(at_lowest));
  } else {
    if (result.point.step != step_of_trial) at(result.point.step);
    accept(std::move(trial), std::move(at_trial));
  }
  return true;
}

MinimiseSummary Descent::finish(StopReason reason) const {
  MinimiseSummary summary;
  summary.reason = reason;
  summary.energy = here_.energy - here_.load_energy;
  summary.residual = here_.residual;
  summary.residual_floor = here_.residual_floor;
  summary.precision = precision_;
  summary.evaluations = evaluations_;
  summary.iterations = iterations_;
  summary.work = work_;
  return summary;
}

}  // namespace isojam
