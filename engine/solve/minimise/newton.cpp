#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "engine/arithmetic/elementary.hpp"
#include "engine/solve/minimise/descent.hpp"
#include "engine/solve/minimise/step_model.hpp"

// Near jamming the stiffnesses of a packing span ten orders of magnitude. Their ratio is the condition number for
// first-order methods, but does not affect Newton's method. Newton's method is limited by the range in which its model
// of the energy holds. Three measures extend this range.
// First, the model anticipates pairs that close and contacts that tilt (step_model.hpp).
// Second, a step that raises the energy is continued before it is rejected (Chamberlain's watchdog technique). Reason:
// if particles rotate together, flat contacts move out of their planes by the square of the angle. This is far more
// than their depth, but one more Newton step corrects it.
// Third, the shift μ shortens steps that still fail (Levenberg, Marquardt).

namespace isojam {

namespace {

/// Largest number of steps from a trial state with a higher energy. If they do not lead to a lower energy, the trial is
/// rejected.
constexpr int follow_ups = 3;

/// A trial is rejected at once if it raises the energy by more than this factor.
constexpr double hopeless = 1e6;

/// Number of failures in one state after which the model no longer anticipates pairs. If the anticipation is incorrect,
/// no shift helps.
constexpr int patience = 4;

/// Probe distance for incipient contacts: fraction of the last step, and lower and upper bounds in units of the
/// inradius.
constexpr double probe_per_step = 0.05, least_probe = 2e-8, most_probe = 2e-3;

/// The shift μ. It is adapted to the quality of the last prediction of the model.
class Shift {
 public:
  void set_scale(double largest_diagonal) {
    scale_ = largest_diagonal;
    least_ = 16 * std::numeric_limits<double>::epsilon() * largest_diagonal;
    // Beyond this limit a step is gradient descent of negligible length. That holds even if closing faces are about to
    // become as stiff as contacts can be (of order 1), which the Hessian does not show.
    most_ = 1e6 * std::max(largest_diagonal, 1.0);
    if (value_ == 0) value_ = 1e-4 * largest_diagonal;
    value_ = std::max(value_, least_);
  }
  double value() const { return value_; }
  bool exhausted() const { return value_ > most_; }
  /// To be called after a failed step. The factor increases with each call.
  void raise() {
    value_ *= growth_;
    growth_ *= 2;
  }
  /// To be called after an accepted step with the ratio of its actual to its predicted decrease (Nielsen's rule).
  void adapt(double ratio) {
    value_ = std::max(value_ * std::max(0.2, 1 - cubed(2 * ratio - 1)), least_);
    growth_ = 2;
  }
  /// To be called after a step that needed follow-up steps.
  void ease() {
    value_ = std::max(value_ / 2, least_);
    growth_ = 2;
  }
  /// To be called before another model is used in the same state.
  void restart() {
    value_ = std::min(value_, 1e-2 * scale_);
    growth_ = 2;
  }

 private:
  double value_ = 0, scale_ = 0, growth_ = 2, least_ = 0, most_ = 0;
};

class Newton {
 public:
  explicit Newton(Descent& descent) : descent_(descent) {}

  MinimiseSummary run() {
    const StopReason reason = descend();
    descent_.count_factorisations(factor_.factorisations, factor_.updates);
    return descent_.finish(reason);
  }

 private:
  StopReason descend() {
    while (true) {
      if (const auto reason = descent_.verdict()) return *reason;
      StepModel model = model_at(descent_.packing(), descent_.here());
      shift_.set_scale(model.largest_diagonal());
      int failures = 0;
      while (!advance(model)) {
        if (shift_.exhausted()) return StopReason::line_search_failed;
        if (const auto reason = descent_.verdict()) return *reason;
        if (++failures == patience) {
          model.forget_closing_pairs();
          shift_.restart();
        }
      }
    }
  }

  StepModel model_at(const Packing& packing, const Evaluation& value) {
    const double inradius = packing.solids.least_inradius();
    const double probe_distance =
        std::clamp(probe_per_step * last_step_, least_probe * inradius, most_probe * inradius);
    return StepModel(descent_.second_order(packing, probe_distance), value.gradient, descent_.longest_displacement());
  }

  /// True if a state with the evaluation `value` is an improvement. `predicted` is the decrease that the model
  /// predicts. If energies do not resolve the step, the forces decide.
  bool acceptable(const Evaluation& value, double predicted) const {
    const Evaluation& here = descent_.here();
    const double actual = here.energy - value.energy;
    if (predicted > here.energy_noise) return actual > 1e-4 * predicted;
    return actual > -here.energy_noise && value.gradient.norm() < here.gradient.norm();
  }

  /// Tries one step with the present shift. Returns true if it was accepted, possibly after follow-up steps.
  bool advance(StepModel& model) {
    const auto step = model.minimise(shift_.value(), factor_, active_);
    if (!step) {
      shift_.raise();
      return false;
    }
    Packing there = descent_.packing();
    Evaluation value = descent_.probe(descent_.packing(), step->displacement, there);
    const double length = largest_displacement(step->displacement);
    if (acceptable(value, step->decrease)) {
      const bool resolved = step->decrease > descent_.here().energy_noise;
      shift_.adapt(resolved ? (descent_.here().energy - value.energy) / step->decrease : 1);
    } else if (follow_up(there, value, step->decrease, length)) {
      shift_.ease();
    } else {
      shift_.raise();
      return false;
    }
    last_step_ = length;
    descent_.accept(std::move(there), std::move(value));
    return true;
  }

  /// Continues from the trial state `there`, which was not acceptable. `length` is its distance from the present state.
  /// Returns true if `there` is an acceptable state at the end.
  bool follow_up(Packing& there, Evaluation& value, double predicted, double length) {
    ActivePairs active = active_;
    for (int k = 0; k < follow_ups; ++k) {
      if (!(value.energy < hopeless * std::abs(descent_.here().energy)) || descent_.verdict()) return false;
      const auto step = model_at(there, value).minimise(shift_.value(), factor_, active);
      if (!step || largest_displacement(step->displacement) > 2 * length) return false;
      Packing next = there;
      Evaluation value_next = descent_.probe(there, step->displacement, next);
      const bool lower = value_next.energy < value.energy;
      there = std::move(next);
      value = std::move(value_next);
      if (acceptable(value, predicted)) {
        active_ = std::move(active);
        return true;
      }
      if (!lower) return false;
    }
    return false;
  }

  Descent& descent_;
  StepFactor factor_;
  Shift shift_;
  ActivePairs active_;
  double last_step_ = 1e-4;
};

}  // namespace

MinimiseSummary minimise_newton(Descent& descent) { return Newton(descent).run(); }

}  // namespace isojam
