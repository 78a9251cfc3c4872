#include "engine/solve/jam.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace isojam {

namespace {

/// Estimated φ − φ_J of a minimised state, from E ∝ (φ − φ_J)⁶: 6E/(dE/dφ), dE/dφ = N p/φ².
double distance_to_jamming(const JamStep& step) {
  return 6 * step.energy_per_particle * step.density * step.density / step.pressure;
}

/// How often an expansion step that failed is tried again at half its length.
constexpr int max_halvings = 4;

class JamRun {
 public:
  JamRun(Packing start, const JamOptions& options, std::stop_token stop,
         const std::function<void(const JamStep&)>& on_step)
      : packing_(std::move(start)), options_(options), stop_(std::move(stop)), on_step_(on_step) {}

  JamResult run() {
    if (consolidate()) expand();
    result_.evaluations = energy_.evaluations();
    result_.counts = energy_.counts();
    fit();
    return std::move(result_);
  }

 private:
  /// Minimises `packing` and appends the step to the path.
  const JamStep& relax(Packing& packing, JamStage stage) {
    MinimiseOptions options = options_.minimise;
    if (stage == JamStage::consolidation) {
      options.residual = std::max(options.residual, options_.passing_residual);
      options.unjammed_energy = std::max(options.unjammed_energy, options_.passing_energy);
      options.max_evaluations = options_.passing_evaluations;
      options.method = Method::lbfgs;
    }
    JamStep step;
    step.stage = stage;
    step.summary = minimise(packing, energy_, options, stop_);
    step.density = packing.density();
    const Evaluation value = energy_.evaluate(packing, step.summary.precision);
    step.energy_per_particle = value.energy / packing.size();
    step.pressure = value.pressure;
    result_.path.push_back(step);
    if (on_step_) on_step_(step);
    return result_.path.back();
  }

  /// True if the run must end here; sets the status.
  bool ended(const JamStep& step) {
    if (step.summary.reason == StopReason::interrupted || stop_.stop_requested()) {
      result_.status = JamStatus::interrupted;
    } else if (step.summary.reason == StopReason::not_finite) {
      result_.status = JamStatus::not_finite;
    } else if (static_cast<int>(result_.path.size()) >= options_.max_steps) {
      result_.status = JamStatus::step_limit;
    } else {
      return false;
    }
    return true;
  }

  bool consolidated(const JamStep& step) const {
    if (step.summary.reason == StopReason::unjammed) return false;
    if (options_.target_before_relaxation) return step.summary.converged();
    return step.energy_per_particle >= options_.target_energy;
  }

  /// The strain step that keeps the unrelaxed energy below the target, at most `consolidation_step`.
  double gentle_step() {
    double step = options_.consolidation_step;
    const double least = step / 64;
    while (step > least) {
      const Packing strained = strained_to(packing_, packing_.density() + step);
      if (energy_.evaluate(strained).energy <= options_.target_energy * packing_.size()) break;
      step /= 2;
    }
    return step;
  }

  /// Strains up to the target energy. False if the run ended on the way.
  bool consolidate() {
    const JamStep* step = &relax(packing_, JamStage::consolidation);
    while (!ended(*step)) {
      if (consolidated(*step)) return true;
      const double strain = options_.target_before_relaxation ? gentle_step() : options_.consolidation_step;
      if (packing_.density() + strain > options_.max_density) {
        result_.status = JamStatus::density_limit;
        return false;
      }
      packing_ = strained_to(packing_, packing_.density() + strain);
      step = &relax(packing_, JamStage::consolidation);
    }
    return false;
  }

  void keep(const Packing& packing) {
    result_.states.push_back(packing);
    result_.state_steps.push_back(static_cast<int>(result_.path.size()) - 1);
  }

  double expansion_step(double distance, double approach) const {
    // Nearer than asked for costs more than it tells.
    const double last = distance - 0.95 * options_.final_distance;
    return std::min({options_.longest_step, approach * distance, last});
  }

  /// Strains down towards φ_J from equilibrium to equilibrium.
  void expand() {
    const JamStep* step = &relax(packing_, JamStage::expansion);
    if (ended(*step)) return;
    result_.status = JamStatus::not_jammed;
    if (!is_equilibrium(step->summary)) return;
    keep(packing_);
    double distance = distance_to_jamming(*step), approach = options_.approach;
    int halvings = 0;
    while (distance > options_.final_distance) {
      Packing next = strained_to(packing_, packing_.density() - expansion_step(distance, approach));
      step = &relax(next, JamStage::expansion);
      if (ended(*step)) return;
      if (!is_equilibrium(step->summary)) {
        if (++halvings > max_halvings) break;
        approach /= 2;
        continue;
      }
      packing_ = std::move(next);
      distance = distance_to_jamming(*step);
      approach = std::min(options_.approach, 1.5 * approach);
      keep(packing_);
    }
    const bool reached = distance <= options_.final_distance;
    if (result_.states.size() >= 2) result_.status = reached ? JamStatus::jammed : JamStatus::short_of_goal;
  }

  void fit() { result_.phi_j = fit_jamming_point(energy_points(result_), options_.fit_window); }

  Packing packing_;
  const JamOptions& options_;
  std::stop_token stop_;
  const std::function<void(const JamStep&)>& on_step_;
  PackingEnergy energy_;
  JamResult result_;
};

}  // namespace

std::string_view to_string(JamStage stage) { return stage == JamStage::consolidation ? "consolidation" : "expansion"; }

std::string_view to_string(JamStatus status) {
  static constexpr std::array<std::string_view, 8> names{"not_called",    "jammed",     "short_of_goal", "not_jammed",
                                                         "density_limit", "step_limit", "not_finite",    "interrupted"};
  return names[static_cast<std::size_t>(status)];
}

std::vector<EnergyPoint> energy_points(const JamResult& result) {
  std::vector<EnergyPoint> points;
  for (const int k : result.state_steps) {
    const JamStep& step = result.path[static_cast<std::size_t>(k)];
    points.push_back({step.density, step.energy_per_particle, step.pressure / (step.density * step.density)});
  }
  return points;
}

JamResult jam(Packing start, const JamOptions& options, std::stop_token stop,
              const std::function<void(const JamStep&)>& on_step) {
  return JamRun(std::move(start), options, std::move(stop), on_step).run();
}

}  // namespace isojam
