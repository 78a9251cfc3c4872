#include "engine/solve/multipliers/envelope_state.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/solve/minimise/descent.hpp"

namespace isojam {

namespace {

/// Differences of Φ below this many times its rounding are none.
constexpr double resolved = 10;

/// No success divides the shift by more than the inverse.
constexpr double least_change = 0.2;

}  // namespace

EnvelopeState EnvelopeEvaluator::at(Packing packing, const std::vector<ContactForce>& forces,
                                    const std::vector<char>& only) {
  EnvelopeEvaluation value = energy_.evaluate(packing, forces, stiffness_, only);
  ++work_.envelopes;
  work_.envelope_overlaps += value.overlaps;
  return {std::move(packing), std::move(value)};
}

EnvelopeState EnvelopeEvaluator::unshifted(Packing packing) {
  EnvelopeEvaluation value = energy_.unshifted(packing, stiffness_);
  ++work_.envelopes;
  work_.envelope_overlaps += value.overlaps;
  return {std::move(packing), std::move(value)};
}

std::vector<ContactForce> forces_after(const EnvelopeState& state, const Eigen::VectorXd& step) {
  std::vector<ContactForce> forces = forces_of(state.value);
  for (std::size_t k = 0; k < forces.size(); ++k) {
    const EnvelopeContact& contact = state.value.contacts[k];
    if (!contact.at.touching) continue;
    const Vector6d change =
        contact.at.shift_change(step.segment<6>(6 * contact.pair.a), step.segment<6>(6 * contact.pair.b));
    forces[k].shift += to_body(state.packing.poses[contact.pair.b], change);
  }
  return forces;
}

bool acceptable(const EnvelopeEvaluation& from, const EnvelopeEvaluation& to, double promised) {
  const double actual = from.value - to.value;
  if (promised > resolved * from.noise) return actual > 1e-4 * promised;
  return actual > -resolved * from.noise && to.gradient.norm() < from.gradient.norm();
}

double adapted_shift(double shift, double ratio) {
  return shift * std::max(least_change, 1 - std::pow(2 * std::min(ratio, 1.0) - 1, 3));
}

Eigen::VectorXd limited(const Eigen::VectorXd& step, double longest) {
  return step * std::min(1.0, longest / largest_displacement(step));
}

}  // namespace isojam
