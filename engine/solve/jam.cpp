#include "engine/solve/jam.hpp"

#include <algorithm>
#include <cassert>
#include <utility>

#include "engine/arithmetic/elementary.hpp"
#include "engine/solve/multipliers/multipliers.hpp"
#include "engine/solve/rearrangement.hpp"

namespace isojam {
namespace {

/// Largest number of steps of a decompression that may fail or end a solution branch, far from jamming and near it.
constexpr int max_halvings = 4, max_halvings_near = 7;

/// Smallest values of MinimiseOptions::residual and MinimiseOptions::unjammed_energy in compression.
constexpr double compression_residual = 1e-3, compression_unjammed_energy = 1e-14;

/// Equilibria are followed if φ − φ_J is below this. Farther away all contacts are soft, and Newton's method converges
/// by itself.
constexpr double followed_within = 1;

/// Nearer to jamming than this, steps that are too long end with StopReason::budget, and a longer one would fail again.
/// A failed step then does not mean that the solution branch has ended, and the steps after it are no longer extended.
constexpr double near_jamming = 1e-3;

/// Residual of the first state of a decompression below which Newton's method finds the equilibrium, and the number of
/// evaluations in which L-BFGS approaches it. They cost less than the iterations that they save.
constexpr double newton_below = 0.01;
constexpr int approach = 500;

/// Mean contact force F at a pressure p, from 3 p V_cell = Σ r·F. Assumes 4.5 contacts per particle, with r = 1.
double mean_force_at(double pressure, double density) { return 3 * pressure / (4.5 * density); }

/// One strain step of a run.
class StrainStep {
 public:
  StrainStep(JamProgress& progress, const JamOptions& options, std::stop_token stop)
      : progress_(progress), result_(progress.result), options_(options), stop_(std::move(stop)) {
    if (options.cohesion.acts()) cohesive_energy_.emplace(options.cohesion);
  }

  void run() {
    if (stop_.stop_requested()) {
      result_.status = JamStatus::interrupted;
    } else if (progress_.stage == JamStage::compression) {
      consolidate();
    } else if (ends_at_zero_pressure(options_)) {
      release_pressure();
    } else {
      expand();
    }
    result_.evaluations += energy_.evaluations();
    result_.counts += energy_.counts();
    if (cohesive_energy_) {
      result_.evaluations += cohesive_energy_->evaluations();
      result_.counts += cohesive_energy_->counts();
    }
    if (progress_.ended()) result_.phi_j = fit_jamming_point(energy_points(result_), options_.decompression.fit_window);
  }

 private:
  MinimiseOptions minimiser() const {
    MinimiseOptions options = options_.minimise;
    options.control = control_at_density(options_);
    return options;
  }

  /// Minimises `packing` and appends the step to the path.
  const JamStep& relax(Packing& packing) { return relax(packing, energy_); }

  const JamStep& relax(Packing& packing, PackingEnergy& energy) {
    MinimiseOptions options = minimiser();
    if (progress_.stage == JamStage::compression) {
      options.residual = std::max(options.residual, compression_residual);
      options.unjammed_energy = std::max(options.unjammed_energy, compression_unjammed_energy);
      options.max_evaluations = options_.compression.evaluations;
      options.method = Method::lbfgs;
    }
    return append(packing, minimise(packing, energy, options, stop_), energy);
  }

  const JamStep& append(const Packing& at, const MinimiseSummary& summary) { return append(at, summary, energy_); }

  const JamStep& append(const Packing& packing, const MinimiseSummary& summary, PackingEnergy& energy) {
    JamStep step;
    step.stage = progress_.stage;
    step.summary = summary;
    step.density = packing.density();
    const Evaluation value = energy.evaluate(packing, step.summary.precision);
    step.energy_per_particle = value.energy / packing.size();
    step.pressure = value.pressure;
    step.deviator = deviator_of(value);
    result_.work += step.summary.work;
    result_.path.push_back(step);
    return result_.path.back();
  }

  /// Returns true and sets the status if the run must end after this step.
  bool must_end(const JamStep& step) {
    if (step.summary.reason == StopReason::interrupted || stop_.stop_requested()) {
      result_.status = JamStatus::interrupted;
    } else if (step.summary.reason == StopReason::not_finite) {
      result_.status = JamStatus::not_finite;
    } else if (step.summary.reason == StopReason::cell_limit) {
      result_.status = JamStatus::cell_limit;
    } else if (static_cast<int>(result_.path.size()) >= options_.max_steps) {
      result_.status = JamStatus::step_limit;
    } else {
      return false;
    }
    return true;
  }

  bool consolidated(const JamStep& step) const {
    if (step.summary.reason == StopReason::unjammed) return false;
    if (options_.compression.target_before_relaxation) return step.summary.converged();
    return step.energy_per_particle >= options_.compression.target_energy;
  }

  /// The next increase of φ. With target_before_relaxation, the energy before relaxation is then below the target.
  double next_strain() {
    const Compression& compression = options_.compression;
    const Packing& packing = progress_.packing;
    if (!compression.target_before_relaxation)
      return cohesive_energy_ ? compression.step : aimed_strain(compression, result_.path.back());
    double step = compression.step;
    while (step > compression.step / 64) {
      const Packing strained = strained_to(packing, packing.density() + step);
      if (energy_.evaluate(strained).energy <= compression.target_energy * packing.size()) break;
      step /= 2;
    }
    return step;
  }

  /// Ends a compression with cohesion if the terms V²/4 reach the target energy after a relaxation without cohesion.
  /// Relaxation only lowers them, so it can be skipped if they are below the target before it.
  void end_cohesive_compression() {
    Packing bare = progress_.packing;
    if (energy_.evaluate(bare).energy < options_.compression.target_energy * bare.size()) return;
    const JamStep& step = relax(bare);
    if (must_end(step) || !consolidated(step)) return;
    progress_.stage = JamStage::decompression;
    if (options_.cohesion_until == CohesionUntil::decompression) progress_.packing = std::move(bare);
  }

  /// Relaxes the packing and its cell to zero pressure, with cohesion.
  void release_pressure() {
    MinimiseOptions options = options_.minimise;
    options.method = Method::newton;
    options.control = control_at_pressure(options_, 0);
    Packing next = progress_.packing;
    const JamStep& step = append(next, minimise(next, *cohesive_energy_, options, stop_), *cohesive_energy_);
    if (must_end(step)) return;
    if (!is_equilibrium(step.summary)) {
      result_.status = JamStatus::not_jammed;
    } else if (energy_.evaluate(next).contacts == 0) {
      result_.status = JamStatus::detached;
    } else {
      keep(std::move(next));
      result_.status = JamStatus::zero_pressure;
    }
  }

  /// A step of compression. The first one only minimises.
  void consolidate() {
    Packing& packing = progress_.packing;
    packing.cell = packing.cell.reduced();
    if (!result_.path.empty()) {
      const double strain = next_strain();
      if (packing.density() + strain > options_.compression.max_density) {
        result_.status = JamStatus::density_limit;
        return;
      }
      packing = strained_to(packing, packing.density() + strain);
    }
    if (cohesive_energy_ && !cohesive_energy_->accepts(packing)) {
      result_.status = JamStatus::cell_limit;
      return;
    }
    const JamStep& step = relax(packing, cohesive_energy_ ? *cohesive_energy_ : energy_);
    if (must_end(step)) return;
    if (cohesive_energy_) return end_cohesive_compression();
    if (consolidated(step)) progress_.stage = JamStage::decompression;
  }

  const JamStep& last_state() const { return result_.path[static_cast<std::size_t>(result_.state_steps.back())]; }

  /// Estimated φ − φ_J of the last equilibrium.
  double distance() const { return distance_to_jamming(last_state()); }

  /// Upper limit of a step of decompression, in addition to the fraction. States nearer than final_distance would be
  /// expensive and are not needed.
  double step_bound() const {
    return std::min(options_.decompression.longest_step, distance() - 0.95 * options_.decompression.final_distance);
  }

  /// Length of a step of decompression. If there is only one state, the next one may be nearer than final_distance.
  double decompression_step() const {
    const double step = progress_.step_fraction * distance(), bound = step_bound();
    return bound > 0 ? std::min(step, bound) : step;
  }

  /// A step of decompression from the last equilibrium. The first one only minimises.
  void expand() {
    if (progress_.lost >= 0) return recompress();
    // Reduced before the step, so that the pairs at both of its ends refer to the same lattice vectors.
    progress_.packing.cell = progress_.packing.cell.reduced();
    Packing next = progress_.packing;
    const bool first = result_.states.empty();
    const JamStep& step = first ? first_state(next) : strained_down(next);
    if (must_end(step)) return;
    if (first && !progress_.jammed && relaxed_below_target(step)) {
      progress_.stage = JamStage::compression;
      progress_.packing = std::move(next);
      return;
    }
    const bool ends_branch = follows() && lost_equilibrium() && options_.decompression.control == Control::density;
    if (!ends_branch && !is_state(step.summary)) return failed(first);
    if (!first && !ends_branch && last_state().energy_per_particle > 0)
      result_.path.back().rearrangement = rearrangement(progress_.packing, last_state(), next, step);
    if (ends_branch) return lose_branch(std::move(next));
    if (!first && distance() > near_jamming)
      progress_.step_fraction = std::min(options_.decompression.step_fraction, 1.5 * progress_.step_fraction);
    // A packing that becomes denser as its pressure decreases has found a denser branch. Energies of the earlier branch
    // contain no information about φ_J of the new one.
    if (!first && options_.decompression.control == Control::pressure && next.density() >= progress_.packing.density())
      forget_states();
    keep(std::move(next));
    const bool bracketed = result_.states.size() > 1 || options_.decompression.control == Control::density;
    if (bracketed && distance_to_jamming(result_.path.back()) <= options_.decompression.final_distance)
      end_decompression(JamStatus::jammed);
  }

  /// The first state of a decompression. Close to an equilibrium, Newton's method converges in a few iterations. From
  /// the end of the compression of a large packing, it needs hundreds, and the method of multipliers far fewer.
  const JamStep& first_state(Packing& next) {
    MinimiseOptions options = minimiser();
    if (options.method != Method::multipliers || energy_.evaluate(next).residual < newton_below) return relax(next);
    options.method = Method::lbfgs, options.residual = newton_below, options.max_evaluations = approach;
    result_.work += minimise(next, energy_, options, stop_).work;
    const Evaluation value = energy_.evaluate(next);
    if (!(value.pressure > 0)) return relax(next);
    const double force = mean_force_at(value.pressure, next.density());
    const double distance = 6 * value.energy / next.size() * next.density() * next.density() / value.pressure;
    return append(next, relax_to_equilibrium(next, force, distance, energy_, minimiser(), stop_));
  }

  /// True if the last state of compression was not in equilibrium, and lost most of its energy in the minimisation.
  /// After a compression with cohesion, such a state is so far from equilibrium that the minimisation need not end.
  bool relaxed_below_target(const JamStep& step) const {
    return !options_.compression.target_before_relaxation &&
           step.energy_per_particle < options_.compression.target_energy / 2 &&
           (is_state(step.summary) || step.summary.reason == StopReason::unjammed || options_.cohesion.acts());
  }

  void forget_states() {
    result_.states.clear();
    result_.state_steps.clear();
  }

  void keep(Packing state) {
    progress_.packing = std::move(state);
    result_.states.push_back(progress_.packing);
    result_.state_steps.push_back(static_cast<int>(result_.path.size()) - 1);
  }

  /// True if the next state is computed from the last equilibrium, and not only from the strained packing.
  bool follows() const {
    return options_.minimise.method == Method::multipliers && !result_.states.empty() &&
           distance() <= followed_within && is_equilibrium(last_state().summary);
  }

  const JamStep& released(Packing& next) {
    const double left = 1 - decompression_step() / distance();
    MinimiseOptions options = options_.minimise;
    options.control = control_at_pressure(options_, nearest::pow(left, 5) * last_state().pressure);
    if (!follows()) return append(next, minimise(next, energy_, options, stop_));
    return append(next, follow_load(next, distance(), energy_, options, stop_));
  }

  const JamStep& strained_down(Packing& next) {
    if (options_.decompression.control == Control::pressure) return released(next);
    const double density = next.density() - decompression_step();
    if (!follows()) {
      next = strained_to(next, density);
      return relax(next);
    }
    return append(next, follow_equilibrium(next, density, distance(), energy_, minimiser(), stop_));
  }

  /// True if the last step unjammed the packing. Also true, unless jamming is near, if the last two steps spent their
  /// budget because the packing slides too far; the second of them was half as long.
  bool lost_equilibrium() const {
    const auto ended = [&](std::size_t back, StopReason reason) {
      return result_.path.size() >= back && result_.path[result_.path.size() - back].summary.reason == reason;
    };
    return ended(1, StopReason::unjammed) ||
           (distance() > near_jamming && ended(1, StopReason::budget) && ended(2, StopReason::budget));
  }

  /// Ends a solution branch: the packing is unjammed at a density where it was expected to be jammed, or it is far from
  /// equilibrium.
  void lose_branch(Packing packing) {
    result_.path.back().lost = true;
    if (exhausted()) return end_decompression(JamStatus::goal_not_reached);
    progress_.packing = std::move(packing);
    progress_.lost = result_.state_steps.back();
    progress_.step_fraction /= 2;  // smaller steps from here on, because the same may happen again
  }

  /// Compresses the packing to an equilibrium from which decompression can continue. The energies of the ended branch
  /// contain no information about φ_J of the new branch.
  void recompress() {
    const JamStep& before = result_.path[static_cast<std::size_t>(progress_.lost)];
    const double distance = distance_to_jamming(before), strain = progress_.step_fraction * distance;
    Packing next = strained_to(progress_.packing, progress_.packing.density() + strain);
    if (next.density() > options_.compression.max_density) return end_decompression(JamStatus::goal_not_reached);
    const double force = mean_force_at(before.pressure, before.density);
    const JamStep& step = append(next, relax_to_equilibrium(next, force, distance, energy_, minimiser(), stop_));
    if (must_end(step)) return;
    progress_.packing = next;
    if (step.summary.reason == StopReason::unjammed) return;
    if (!is_state(step.summary)) return failed(false);
    if (distance_to_jamming(step) < options_.decompression.final_distance / (1 - options_.decompression.step_fraction))
      return;
    progress_.lost = -1;
    forget_states();
    keep(std::move(next));
  }

  /// True for an equilibrium, and for a state that satisfies the rule minimise.energy_change, as in other published
  /// protocols.
  bool is_state(const MinimiseSummary& summary) const {
    return is_equilibrium(summary) || summary.reason == StopReason::energy_change;
  }

  /// Counts a step that failed, or ended a branch. True if there were too many.
  bool exhausted() { return ++progress_.halvings > (distance() > near_jamming ? max_halvings : max_halvings_near); }

  /// After a failed step, the next one is half as long, whichever limit determined it; the same step would fail again.
  void failed(bool first) {
    if (first || exhausted()) return end_decompression(JamStatus::goal_not_reached);
    // As in decompression_step(), a bound that is not positive does not count.
    if (const double bound = step_bound(); bound > 0)
      progress_.step_fraction = std::min(progress_.step_fraction, bound / distance());
    progress_.step_fraction /= 2;
  }

  void end_decompression(JamStatus status) {
    if (static_cast<int>(result_.cycles.size()) < options_.cycles) return end_cycle();
    result_.status = result_.states.size() >= 2 ? status : JamStatus::not_jammed;
  }

  /// Keeps the result of a training cycle, and continues with compression from its last state.
  void end_cycle() {
    result_.cycles.push_back(cycle_of(result_, options_.decompression.fit_window));
    forget_states();
    JamProgress next = begin_jam(std::move(progress_.packing), options_);
    next.result = std::move(result_);
    progress_ = std::move(next);
  }

  JamProgress& progress_;
  JamResult& result_;
  const JamOptions& options_;
  std::stop_token stop_;
  std::optional<PackingEnergy> cohesive_energy_;
  PackingEnergy energy_;  // for this step only: its counts must not depend on caches of an earlier step
};

}  // namespace

JamProgress begin_jam(Packing start, const JamOptions& options) {
  return {std::move(start), JamStage::compression, options.decompression.step_fraction, 0, -1, {}};
}

JamProgress begin_decompression(Packing jammed, const JamOptions& options) {
  return {std::move(jammed), JamStage::decompression, options.decompression.step_fraction, 0, -1, {}, true};
}

void advance(JamProgress& progress, const JamOptions& options, std::stop_token stop) {
  assert(!progress.ended());
  StrainStep(progress, options, std::move(stop)).run();
}

JamResult jam(JamProgress from, const JamOptions& options, std::stop_token stop, const OnProgress& on_progress) {
  while (!from.ended()) {
    advance(from, options, stop);
    if (on_progress && from.result.status != JamStatus::interrupted) on_progress(from);
  }
  return std::move(from.result);
}

JamResult jam(Packing start, const JamOptions& options, std::stop_token stop, const OnProgress& on_progress) {
  return jam(begin_jam(std::move(start), options), options, std::move(stop), on_progress);
}

}  // namespace isojam
