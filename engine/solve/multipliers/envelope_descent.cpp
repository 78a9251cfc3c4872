#include "engine/solve/multipliers/envelope_descent.hpp"

#include <algorithm>
#include <limits>

#include "engine/solve/multipliers/local_relaxation.hpp"

namespace isojam {

namespace {

/// λ/k₀, and λ_P/k₀ of the first preconditioner
constexpr double first_shift = 1, least_shift = 1e-7, most_shift = 1e12, first_preconditioner_shift = 64;

/// relaxed_below: local relaxation follows if the decrease of Φ is less than this fraction of the predicted decrease.
/// trusted_above: after a local relaxation, λ is adapted only if the decrease is more than this fraction.
constexpr double relaxed_below = 0.5, trusted_above = 0.8;

/// If the decrease is below this fraction of the predicted decrease, the next λ is at least a quarter of that of the
/// step, also if only the largest displacement had determined it.
constexpr double poor = 0.25;

}  // namespace

EnvelopeDescent::EnvelopeDescent(EnvelopeEvaluator& evaluator, BlockCholesky& complete, MinimiseWork& work)
    : evaluator_(evaluator), work_(work), models_(first_preconditioner_shift, complete), shift_(first_shift) {}

void EnvelopeDescent::set_stiffness(double k0) {
  shift_ *= k0 / k0_;
  models_.scale(k0 / k0_);
  k0_ = k0;
}

bool EnvelopeDescent::failed() const { return !(shift_ <= most_shift * k0_); }

std::optional<EnvelopeState> EnvelopeDescent::step(const EnvelopeState& here, double longest,
                                                   const std::function<bool()>& must_stop) {
  ++work_.hessians;
  const std::optional<KrylovModel> model =
      models_.model(evaluator_.curvature(here), here.value.gradient, shift_, work_);
  if (!model) {
    shift_ = std::numeric_limits<double>::infinity();
    return std::nullopt;
  }
  double more = 2;
  while (!must_stop()) {
    const KrylovStep step = model->step(shift_, longest);
    EnvelopeState there = evaluator_.at(moved(here.packing, step.step), forces_after(here, step.step));
    bool relaxed = false;
    if (here.value.value - there.value.value < relaxed_below * step.predicted_decrease)
      relaxed =
          relax_locally(mispredicted(here, there, step.step, step.predicted_decrease),
                        std::max(step.shift, models_.negative()), step.predicted_decrease, evaluator_, there, work_);
    if (acceptable(here.value, there.value, step.predicted_decrease)) {
      adapt(here, there, step, relaxed, more > 2);
      return there;
    }
    shift_ = more * step.shift;
    more *= 2;
  }
  return std::nullopt;
}

void EnvelopeDescent::adapt(const EnvelopeState& from, const EnvelopeState& to, const KrylovStep& step, bool relaxed,
                            bool repeated) {
  const bool resolved = step.predicted_decrease > from.value.noise;
  const double ratio = resolved ? (from.value.value - to.value.value) / step.predicted_decrease : 1;
  if (repeated || ratio < poor) shift_ = std::max(shift_, step.shift / 4);
  if (!relaxed || ratio > trusted_above) shift_ = adapted_shift(shift_, ratio);
  shift_ = std::max(shift_, least_shift * k0_);
}

}  // namespace isojam
