#include "engine/solve/multipliers/envelope_state.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include "engine/arithmetic/elementary.hpp"
#include "engine/packing/cell/strain.hpp"
#include "engine/solve/minimise/descent.hpp"

namespace isojam {

namespace {

/// Differences of Φ are significant if they are larger than this many times the rounding error of Φ.
constexpr double resolved = 10;

/// Smallest factor by which adapted_shift() multiplies the shift.
constexpr double least_change = 0.2;

}  // namespace

EnvelopeState EnvelopeEvaluator::at(Packing packing, const std::vector<ContactMultiplier>& forces,
                                    const std::vector<char>& only) {
  if (load_.control().cell != CellFreedom::fixed && !is_legal(packing.cell, packing.solids.widest())) {
    cell_limit_ = true;
    EnvelopeEvaluation nowhere;
    nowhere.value = std::numeric_limits<double>::infinity();
    nowhere.gradient = Eigen::VectorXd::Zero(6 * packing.size());
    nowhere = load_.of(std::move(nowhere), packing);
    return {std::move(packing), std::move(nowhere)};
  }
  EnvelopeEvaluation value = energy_.evaluate(packing, forces, terms_, only);
  ++work_.envelopes;
  work_.envelope_overlaps += value.overlaps;
  if (only.empty()) value = load_.of(std::move(value), packing);
  return {std::move(packing), std::move(value)};
}

EnvelopeState EnvelopeEvaluator::unshifted(Packing packing) {
  EnvelopeEvaluation value = load_.of(energy_.unshifted(packing, terms_.stiffness), packing);
  ++work_.envelopes;
  work_.envelope_overlaps += value.overlaps;
  return {std::move(packing), std::move(value)};
}

BlockMatrix EnvelopeEvaluator::curvature(const EnvelopeState& state) const {
  BlockMatrix matrix = isojam::curvature(state.value, state.packing.size(), load_.control().cell);
  load_.add_to(matrix, state.packing);
  return matrix;
}

Eigen::Matrix3d strain_of(const Eigen::VectorXd& step, int particles) {
  const Eigen::Index strains = step.size() - 6 * Eigen::Index{particles};
  if (strains == 0) return Eigen::Matrix3d::Zero();
  return strain_tensor(strain_basis(freedom_of(strains)) * step.tail(strains) / strain_length(particles));
}

Vector6d step_of_b(const EnvelopeContact& contact, const Eigen::VectorXd& step, const Eigen::Matrix3d& strain) {
  Vector6d of_b = step.segment<6>(6 * contact.pair.b);
  if (!strain.isZero(0)) of_b.head<3>() += strain * contact.displacement;
  return of_b;
}

std::vector<ContactMultiplier> forces_after(const EnvelopeState& state, const Eigen::VectorXd& step) {
  std::vector<ContactMultiplier> forces = forces_of(state.value);
  const Eigen::Matrix3d strain = strain_of(step, state.packing.size());
  for (std::size_t k = 0; k < forces.size(); ++k) {
    const EnvelopeContact& contact = state.value.contacts[k];
    if (!contact.at->touching) continue;
    const Vector6d change =
        contact.at->shift_change(step.segment<6>(6 * contact.pair.a), step_of_b(contact, step, strain));
    forces[k].shift += to_body(state.packing.poses[contact.pair.b], change);
  }
  return forces;
}

bool acceptable(const EnvelopeEvaluation& from, const EnvelopeEvaluation& to, double predicted_decrease) {
  const double actual = from.value - to.value;
  if (predicted_decrease > resolved * from.noise) return actual > 1e-4 * predicted_decrease;
  return actual > -resolved * from.noise && to.gradient.norm() < from.gradient.norm();
}

double adapted_shift(double shift, double ratio) {
  return shift * std::max(least_change, 1 - cubed(2 * std::min(ratio, 1.0) - 1));
}

Eigen::VectorXd limited(const Eigen::VectorXd& step, double longest) {
  return step * std::min(1.0, longest / largest_displacement(step));
}

}  // namespace isojam
