#include "engine/vibration/relax_to_minimum.hpp"

#include <algorithm>
#include <optional>
#include <utility>

#include "engine/packing/enthalpy.hpp"
#include "engine/solve/minimise/descent.hpp"
#include "engine/vibration/strict.hpp"

namespace isojam {

namespace {

/// Largest number of halvings of a trial step. The last step is 1e-12 of the first step, less than the depth of any
/// relevant contact.
constexpr int max_halvings = 40;

/// The packing after a displacement along +mode or −mode, whichever has the lower enthalpy. The length is the largest
/// trial step that decreases the enthalpy by more than its rounding errors. nullopt if no trial step does.
std::optional<Packing> step_down(const Packing& packing, const Eigen::VectorXd& mode, double first_step,
                                 Precision precision, const Enthalpy& enthalpy, PackingEnergy& energy) {
  const auto evaluate = [&](const Packing& there) { return enthalpy.of(energy.evaluate(there, precision), there); };
  const Evaluation here = evaluate(packing);
  double step = first_step * packing.solids.least_inradius() / largest_displacement(mode);
  for (int halving = 0; halving < max_halvings; ++halving) {
    Packing ahead = moved(packing, step * mode), behind = moved(packing, -step * mode);
    const double at_ahead = evaluate(ahead).energy, at_behind = evaluate(behind).energy;
    if (std::min(at_ahead, at_behind) < here.energy - here.energy_noise) return at_ahead <= at_behind ? ahead : behind;
    step /= 2;
  }
  return std::nullopt;
}

class Follower {
 public:
  Follower(const Packing& packing, const MinimumSearchOptions& options, std::stop_token stop)
      : options_(options),
        stop_(std::move(stop)),
        enthalpy_(options.minimise.control, packing.cell),
        result_{.packing = packing} {}

  MinimumSearchResult follow() {
    result_.ended = descend();
    return std::move(result_);
  }

 private:
  MinimumSearchEnd descend() {
    minimise_state();
    while (true) {
      if (!is_equilibrium(result_.summary)) return MinimumSearchEnd::lost_balance;
      const std::optional<Eigen::VectorXd> mode = assess_state();
      if (result_.stability.verdict == Verdict::undetermined) return MinimumSearchEnd::undetermined;
      if (result_.stability.negative == 0)
        return result_.descents == 0 ? MinimumSearchEnd::was_minimum : MinimumSearchEnd::reached_minimum;
      if (!mode) return MinimumSearchEnd::undetermined;
      if (result_.descents == options_.max_descents) return MinimumSearchEnd::still_unstable;
      std::optional<Packing> lower =
          step_down(result_.packing, *mode, options_.first_step, result_.summary.precision, enthalpy_, energy_);
      if (!lower) return MinimumSearchEnd::still_unstable;
      result_.packing = std::move(*lower);
      ++result_.descents;
      minimise_state();
    }
  }

  void minimise_state() {
    result_.stability = {};
    result_.summary = minimise(result_.packing, energy_, options_.minimise, stop_);
  }

  /// Assesses the state, and returns the direction of descent if it is a saddle. The direction is the lowest mode of
  /// the particles. If the particles alone have no negative mode, it is the softest strain.
  std::optional<Eigen::VectorXd> assess_state() {
    const Precision precision = result_.summary.precision;
    const Evaluation here = energy_.evaluate(result_.packing, precision);
    const double torque = unbalanced_torque(here, result_.packing.solids);
    const BlockMatrix matrix = energy_.hessian(result_.packing, precision);
    const SpectrumEnds ends = spectrum_ends(matrix, options_.modes);
    result_.stability = assess(matrix, ends, torque);
    const CellControl& control = options_.minimise.control;
    if (result_.stability.negative == 0 && control.cell != CellFreedom::fixed) {
      const BlockMatrix bordered = enthalpy_hessian(result_.packing, control, precision);
      result_.stability = assess(bordered, ends, torque);
      if (const auto soft = softest_strain(bordered)) return soft->step;
      return std::nullopt;
    }
    if (ends.lowest.size() == 0) return std::nullopt;
    return ends.lowest.vectors.col(0);
  }

  const MinimumSearchOptions& options_;
  std::stop_token stop_;
  Enthalpy enthalpy_;
  PackingEnergy energy_;
  MinimumSearchResult result_;
};

}  // namespace

MinimumSearchResult relax_to_minimum(const Packing& packing, const MinimumSearchOptions& options,
                                     std::stop_token stop) {
  return Follower(packing, options, std::move(stop)).follow();
}

}  // namespace isojam
