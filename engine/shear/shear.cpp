#include "engine/shear/shear.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "engine/packing/cell/strain.hpp"
#include "engine/packing/enthalpy.hpp"
#include "engine/solve/multipliers/multipliers.hpp"
#include "engine/vibration/relax_to_minimum.hpp"

namespace isojam {

namespace {

/// Largest number of times that a load is applied again. A dead load equals the requested stress only before the strain
/// that it causes. It is therefore applied again, with the new state as the reference, until the stress agrees.
constexpr int most_renewals = 8;

/// γ of a deformation without its rotation, from FᵀF = exp(2 ε) to first order in ε.
double strain_of_deformation(const Eigen::Matrix3d& f, ShearMode mode) {
  const Eigen::Matrix3d green = (f.transpose() * f - Eigen::Matrix3d::Identity()) / 2;
  return mode == ShearMode::pure ? green(0, 0) - green(1, 1) : 2 * green(0, 1);
}

class Shear {
 public:
  Shear(const Packing& start, const ShearOptions& options, std::stop_token stop)
      : options_(options), stop_(std::move(stop)), start_cell_(start.cell) {
    if (!(options.step > 0 && options.until >= options.step))
      throw std::invalid_argument("the step of a shear must be positive and not above its end");
    result_.states.push_back(measured(start, 0, {}));
    pressure_ = result_.states.front().pressure;
    if (!(pressure_ > 0)) throw std::invalid_argument("a packing without pressure is not jammed and cannot be sheared");
  }

  ShearResult run() {
    result_.ended = ShearEnd::completed;
    const auto steps = static_cast<int>(std::ceil(options_.until / options_.step * (1 - 1e-9)));
    for (int k = 1; k <= steps && result_.ended == ShearEnd::completed; ++k)
      advance(std::min(k * options_.step, options_.until));
    for (int k = steps - 1; options_.back && k >= 0 && result_.ended == ShearEnd::completed; --k)
      advance(k * options_.step);
    return std::move(result_);
  }

 private:
  const ShearState& here() const { return result_.states.back(); }

  /// Estimate of φ − φ_J from E ∝ Δφ⁶. It is used for scales.
  double distance() const {
    const double phi = here().packing.density();
    return 6 * here().energy / here().packing.size() * phi * phi / here().pressure;
  }

  ShearState measured(Packing packing, double load, const MinimiseSummary& summary) {
    const Evaluation value = energy_.evaluate(packing, Precision::double_double);
    ShearState state{.packing = std::move(packing), .load = load};
    state.stress = shear_stress(value.stress, options_.mode);
    state.full_stress = value.stress;
    state.pressure = value.pressure;
    state.energy = value.energy;
    state.contacts = value.contacts;
    state.summary = summary;
    return state;
  }

  void advance(double load) {
    if (stop_.stop_requested()) {
      result_.ended = ShearEnd::interrupted;
      return;
    }
    ShearState next = options_.control == ShearControl::strain ? strained_to(load) : loaded_to(load);
    if (const ShearEnd end = end_of(next.summary.reason); end != ShearEnd::completed) {
      result_.ended = end;
      return;
    }
    judge(next);
    result_.states.push_back(std::move(next));
  }

  static ShearEnd end_of(StopReason reason) {
    switch (reason) {
      case StopReason::residual_reached:
      case StopReason::precision_floor: return ShearEnd::completed;
      case StopReason::unjammed: return ShearEnd::unjammed;
      case StopReason::cell_limit: return ShearEnd::cell_limit;
      case StopReason::interrupted: return ShearEnd::interrupted;
      default: return ShearEnd::no_equilibrium;
    }
  }

  /// Relaxes an equilibrium to a minimum if it is a saddle.
  ShearState settled(Packing packing, const MinimiseSummary& summary, double load, const CellControl& control) {
    if (!is_equilibrium(summary)) return measured(std::move(packing), load, summary);
    MinimumSearchOptions search;
    search.minimise = options_.minimise;
    search.minimise.control = control;
    search.modes.lowest = 4;
    MinimumSearchResult found = relax_to_minimum(packing, search, stop_);
    ShearState state = measured(std::move(found.packing), load, found.summary);
    state.descents = found.descents;
    return state;
  }

  ShearState strained_to(double load) {
    const double change = load - here().load;
    Packing packing = here().packing;
    packing.cell = packing.cell.reduced();
    const DoubleDoubleMatrix f = shear_deformation(change, options_.mode);
    if (!is_legal(packing.cell.deformed(f), packing.solids.widest())) return limit(load);
    const MinimiseSummary summary = follow_deformation(packing, f, distance(), energy_, options_.minimise, stop_);
    ShearState state = settled(std::move(packing), summary, load, {});
    state.strain = load;
    return state;
  }

  ShearState limit(double load) const {
    ShearState state = here();
    state.load = load;
    state.summary.reason = StopReason::cell_limit;
    return state;
  }

  ShearState loaded_to(double load) {
    MinimiseOptions options = options_.minimise;
    options.control = {CellFreedom::free, pressure_, deviator_with(load * pressure_, options_.mode)};
    Packing packing = here().packing;
    MinimiseSummary summary = follow_load(packing, distance(), energy_, options, stop_);
    for (int k = 0; k < most_renewals && is_equilibrium(summary) && !balanced(packing, options.control); ++k)
      summary = minimise(packing, energy_, options, stop_);
    ShearState state = settled(std::move(packing), summary, load, options.control);
    const Eigen::Matrix3d f = state.packing.cell.vectors().high * start_cell_.vectors().high.inverse();
    state.strain = strain_of_deformation(f, options_.mode);
    return state;
  }

  /// True if the stress equals the requested stress, computed with the present cell as the reference of the load.
  bool balanced(const Packing& packing, const CellControl& control) {
    const Evaluation value = energy_.evaluate(packing, Precision::double_double);
    return Enthalpy(control, packing.cell).of(value, packing).residual <= options_.minimise.residual;
  }

  /// Sets `dissipated` and `dropped` of a state that follows here().
  void judge(ShearState& next) const {
    const double volume = (here().packing.cell.volume() + next.packing.cell.volume()) / 2;
    const double shear_work = volume * (here().stress + next.stress) / 2 * (next.strain - here().strain);
    const double pressure = (here().pressure + next.pressure) / 2;
    const double volume_work = -pressure * (next.packing.cell.volume() - here().packing.cell.volume());
    next.dissipated = shear_work + volume_work - (next.energy - here().energy);
    next.dropped = next.descents > 0 || next.dissipated > drop_part * here().energy;
  }

  const ShearOptions& options_;
  std::stop_token stop_;
  PeriodicCell start_cell_;
  PackingEnergy energy_;
  ShearResult result_;
  double pressure_ = 0;
};

}  // namespace

ShearResult shear(const Packing& start, const ShearOptions& options, std::stop_token stop) {
  return Shear(start, options, std::move(stop)).run();
}

double shear_stress(const Eigen::Matrix3d& stress, ShearMode mode) {
  return mode == ShearMode::pure ? (stress(0, 0) - stress(1, 1)) / 2 : (stress(0, 1) + stress(1, 0)) / 2;
}

Eigen::Matrix3d deviator_with(double shear_stress, ShearMode mode) {
  Eigen::Matrix3d deviator = Eigen::Matrix3d::Zero();
  if (mode == ShearMode::pure) {
    deviator(0, 0) = shear_stress, deviator(1, 1) = -shear_stress;
  } else {
    deviator(0, 1) = deviator(1, 0) = shear_stress;
  }
  return deviator;
}

DoubleDoubleMatrix shear_deformation(double strain, ShearMode mode) {
  if (mode == ShearMode::pure) {
    Eigen::Matrix3d tensor = Eigen::Matrix3d::Zero();
    tensor(0, 0) = strain / 2, tensor(1, 1) = -strain / 2;
    return exponential(tensor);
  }
  DoubleDoubleMatrix f;
  f.high(0, 1) = strain;
  return f;
}

}  // namespace isojam
