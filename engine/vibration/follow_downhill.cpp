#include "engine/vibration/follow_downhill.hpp"

#include <algorithm>
#include <array>
#include <optional>
#include <utility>

#include "engine/solve/minimise/descent.hpp"

namespace isojam {

namespace {

/// Halvings of a trial step: down to 1e-12 of the first, less than the depth of any contact that matters.
constexpr int max_halvings = 40;

/// The packing moved along ±mode, by the longest trial step that lowers the energy by more than its noise, to the lower
/// side.
std::optional<Packing> step_down(const Packing& packing, const Eigen::VectorXd& mode, double first_step,
                                 Precision precision, PackingEnergy& energy) {
  const Evaluation here = energy.evaluate(packing, precision);
  double step = first_step * packing.solid->inradius() / largest_displacement(mode);
  for (int halving = 0; halving < max_halvings; ++halving) {
    Packing ahead = moved(packing, step * mode), behind = moved(packing, -step * mode);
    const double at_ahead = energy.evaluate(ahead, precision).energy;
    const double at_behind = energy.evaluate(behind, precision).energy;
    if (std::min(at_ahead, at_behind) < here.energy - here.energy_noise) return at_ahead <= at_behind ? ahead : behind;
    step /= 2;
  }
  return std::nullopt;
}

class Follower {
 public:
  Follower(const Packing& packing, const DownhillOptions& options, std::stop_token stop)
      : options_(options), stop_(std::move(stop)), result_{.packing = packing} {}

  DownhillResult follow() {
    result_.ended = descend();
    return std::move(result_);
  }

 private:
  DownhillEnd descend() {
    minimise_here();
    const double first_energy = result_.summary.energy;
    while (true) {
      result_.energy_drop = first_energy - result_.summary.energy;
      if (!is_equilibrium(result_.summary)) return DownhillEnd::lost_balance;
      const SpectrumEnds ends = assess_here();
      if (result_.stability.verdict == Verdict::undetermined) return DownhillEnd::undetermined;
      if (result_.stability.negative == 0)
        return result_.descents == 0 ? DownhillEnd::was_minimum : DownhillEnd::reached_minimum;
      if (ends.lowest.size() == 0) return DownhillEnd::undetermined;
      if (result_.descents == options_.max_descents) return DownhillEnd::still_unstable;
      std::optional<Packing> lower = step_down(result_.packing, ends.lowest.vectors.col(0), options_.first_step,
                                               result_.summary.precision, energy_);
      if (!lower) return DownhillEnd::still_unstable;
      result_.packing = std::move(*lower);
      ++result_.descents;
      minimise_here();
    }
  }

  void minimise_here() {
    result_.stability = {};
    result_.summary = minimise(result_.packing, energy_, options_.minimise, stop_);
  }

  SpectrumEnds assess_here() {
    const Precision precision = result_.summary.precision;
    const Evaluation here = energy_.evaluate(result_.packing, precision);
    const BlockMatrix matrix = energy_.hessian(result_.packing, precision);
    SpectrumEnds ends = spectrum_ends(matrix, options_.modes);
    result_.stability = assess(matrix, ends, unbalanced_torque(here, result_.packing.solid->gyration_radius()));
    return ends;
  }

  const DownhillOptions& options_;
  std::stop_token stop_;
  PackingEnergy energy_;
  DownhillResult result_;
};

}  // namespace

DownhillResult follow_downhill(const Packing& packing, const DownhillOptions& options, std::stop_token stop) {
  return Follower(packing, options, std::move(stop)).follow();
}

}  // namespace isojam
