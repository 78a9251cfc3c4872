#include "engine/solve/minimise/step_model.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/solve/factor/low_rank_update.hpp"
#include "engine/solve/minimise/descent.hpp"

// Near jamming the series E + g·s + ½ s·H s is valid only for steps up to the depth of a flat contact, 1e-10 or less.
// Two effects occur in longer steps: pairs close, and flat contacts tilt. The model of a pair has a spring for each
// effect.
//
// Closing. The sketch shows V of a vertex on a face. In the step, two faces of the particles become coplanar.
//
//    V |                                 *
//      |                                * closed: tangent in the closed state
//      |                               *
//      |                              *   . . . . now: tangent in the present state
//      |                          * *.
//      |                  * * * *   .
//      |          * * * *          .
//      |  * * * *                 .
//    0 +-------------------------.-------------------------> step, here an approach
//      |                        .
//
// The model is V = max(0, now, closed), drawn with *. It is a lower bound, because V of a flat contact is convex. If
// the pair has a gap, now = 0.
//
// Tilting. The faces of a flat contact rotate relative to each other, until the line in which the two face planes
// intersect crosses the faces. Before that, V is linear in the rotation, so H does not contain a stiffness against it.
//
// Terms of the model:
//
//   incipient contact    A pair that touches, or that would touch if the centres were closer by the probe distance
//                        (incipient_contact.hpp). The probe distance is a fraction of the last step. The model ignores
//                        all other pairs.
//   linearised overlap   V to first order in s, at_rest + slope·s. A pair has two of them: now and closed.
//   tilt term            The energy ½ τ·Tτ, where τ is the relative rotation of the pair and T is
//                        IncipientContact::tilt.
//   active set           The pairs that close or tilt in the step. A pair closes if closed > max(0, now). It then has
//                        the energy ¼ closed², which adds ½ ∇V ∇Vᵀ to H. A pair tilts if its tilt term is large
//                        compared with its energy. It then has a fraction w of its tilt term.
//   shift                The Levenberg–Marquardt parameter μ, the same for every coordinate. The larger μ is, the
//                        larger is the fraction w of the tilt term of all contacts. A pair whose spring is softer than
//                        μ does not close in the model.
//
// The step is the zero of the gradient of g·s + ½ s·(H + μ)s + Σ_closing ¼ closed² + Σ ½ w τ·Tτ. This is a linear
// system. The active set depends on s, and s on the active set. They are therefore determined alternately in a few
// rounds. In the predicted decrease, each closing pair costs ¼ (closed² − now²). Tilt terms and the shift only shorten
// the step as a precaution; they do not count in the predicted decrease.
//
// The constants below were measured for packings of 100 octahedra and tetrahedra at φ − φ_J = 0.02 … 0.004 after an
// affine strain step. Changing any of them by a factor of three changes the number of evaluations to equilibrium by
// less than a fifth.

namespace isojam {

namespace {

/// Number of rounds that may remove pairs from the active set. Later rounds only add pairs, so that the rounds end.
constexpr int releasing_rounds = 2;

/// Fraction w of the tilt term of a tilted contact. T is the stiffness for a line of intersection through the centre of
/// the contact; elsewhere the stiffness is smaller.
constexpr double tilted = 0.1;

/// A contact counts as tilted if τ·Tτ in the step is more than the fraction `tilt_onset` of its energy. If it is not
/// more than the fraction `tilt_release`, the contact is not in the initial estimate of the next step.
constexpr double tilt_onset = 0.5, tilt_release = 0.05;

/// If the shift is at least this fraction of the largest diagonal entry of H, all contacts have their full tilt term, w
/// = 1. If it is smaller, w is proportional to the shift.
constexpr double stiffened_at = 1e-6;

/// Largest number of terms per particle with which later rounds update the factorisation of an earlier round. A
/// factorisation costs as much as that many solutions of the linear system (17 for N = 100, 55 for N = 400).
constexpr double updates_per_particle = 1.0 / 6;

/// The tangent in the closed state is used only if its squared slope is at least this many times the squared slope of
/// the tangent in the present state.
constexpr double steeper = 2;

double tilt_energy(const IncipientContact& pair, const Eigen::VectorXd& step) {
  const Eigen::Vector3d tilt = pair.relative_rotation(step);
  return tilt.dot(pair.tilt * tilt);
}

double contact_energy(const IncipientContact& pair) { return pair.now.at_rest * pair.now.at_rest / 4; }

double squared_norm(const LinearisedOverlap& volume) {
  return volume.slope_a.squaredNorm() + volume.slope_b.squaredNorm();
}

bool touching(const IncipientContact& pair) { return pair.now.at_rest > 0; }

bool contains(const std::vector<std::pair<int, int>>& sorted, const IncipientContact& pair) {
  return std::binary_search(sorted.begin(), sorted.end(), std::pair(pair.a, pair.b));
}

void add_tilt(double weight, const IncipientContact& pair, BlockMatrix& matrix, BlockMatrix::Block& block) {
  const Eigen::Matrix3d stiffness = weight * pair.tilt;
  matrix.diagonal[block.row].bottomRightCorner<3, 3>() += pair.rotation_scale_a * pair.rotation_scale_a * stiffness;
  matrix.diagonal[block.column].bottomRightCorner<3, 3>() += pair.rotation_scale_b * pair.rotation_scale_b * stiffness;
  block.value.bottomRightCorner<3, 3>() -= pair.rotation_scale_a * pair.rotation_scale_b * stiffness;
}

/// Vectors v with Σ v vᵀ = `stiffness`.
std::vector<Eigen::Vector3d> roots(const Eigen::Matrix3d& stiffness) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes(stiffness);
  std::vector<Eigen::Vector3d> list;
  for (int k = 0; k < 3; ++k) {
    const double value = axes.eigenvalues()[k];
    if (value > std::numeric_limits<double>::epsilon() * axes.eigenvalues()[2])
      list.emplace_back(std::sqrt(value) * axes.eigenvectors().col(k));
  }
  return list;
}

}  // namespace

StepModel::StepModel(SecondOrder second, Eigen::VectorXd gradient, double longest)
    : second_(std::move(second)), gradient_(std::move(gradient)), longest_(longest), states_(second_.pairs.size()) {
  for (const Matrix6d& block : second_.hessian.diagonal)
    largest_diagonal_ = std::max(largest_diagonal_, block.diagonal().maxCoeff());
}

void StepModel::forget_closing_pairs() {
  std::erase_if(second_.pairs, [](const IncipientContact& pair) { return !touching(pair); });
  for (IncipientContact& pair : second_.pairs) pair.closed = {};
  states_.assign(second_.pairs.size(), {});
}

void StepModel::recall(const ActivePairs& active, double shift) {
  for (std::size_t k = 0; k < states_.size(); ++k) {
    const IncipientContact& pair = second_.pairs[k];
    states_[k] = {may_close(pair, shift) && contains(active.closing, pair),
                  touching(pair) && contains(active.tilted, pair)};
  }
}

ActivePairs StepModel::active_pairs(const Eigen::VectorXd& step) const {
  ActivePairs active;
  for (std::size_t k = 0; k < states_.size(); ++k) {
    const IncipientContact& pair = second_.pairs[k];
    if (states_[k].closing) active.closing.emplace_back(pair.a, pair.b);
    if (states_[k].tilted && tilt_energy(pair, step) > tilt_release * contact_energy(pair))
      active.tilted.emplace_back(pair.a, pair.b);
  }
  return active;
}

/// True if the pair can close in the model: its closed tangent is steep enough, and its spring is stiffer than the
/// shift.
bool StepModel::may_close(const IncipientContact& pair, double shift) const {
  const double closed = squared_norm(pair.closed);
  return closed > 2 * shift && closed >= steeper * squared_norm(pair.now);
}

/// Updates the active set for a step. Returns true if it has changed.
bool StepModel::revise(const Eigen::VectorXd& step, double shift, bool may_release) {
  bool changed = false;
  for (std::size_t k = 0; k < states_.size(); ++k) {
    const IncipientContact& pair = second_.pairs[k];
    State& state = states_[k];
    if (may_close(pair, shift)) {
      const bool closes = pair.closed.at(step, pair.a, pair.b) > std::max(0.0, pair.now.at(step, pair.a, pair.b));
      if (closes != state.closing && (closes || may_release)) state.closing = closes, changed = true;
    }
    if (!state.tilted && touching(pair) && tilt_energy(pair, step) > tilt_onset * contact_energy(pair))
      state.tilted = changed = true;
  }
  return changed;
}

/// The fraction w of the tilt term of a pair.
double StepModel::tilt_weight(const IncipientContact& pair, const State& state, double shift) const {
  if (!touching(pair) && !state.closing) return 0;
  const double everywhere = std::min(1.0, shift / (stiffened_at * largest_diagonal_));
  return std::max(everywhere, state.tilted ? tilted : 0.0);
}

/// H plus the terms ½ ∇V ∇Vᵀ of closing pairs and the tilt terms.
BlockMatrix StepModel::assembled(double shift) const {
  const std::vector<BlockMatrix::Block>& present = second_.hessian.off_diagonal;
  BlockMatrix sum;
  sum.diagonal = second_.hessian.diagonal;
  sum.border = second_.hessian.border;
  sum.corner = second_.hessian.corner;
  std::size_t next = 0;
  // Pairs have the same order as blocks: this merges two sorted lists.
  const auto copy_up_to = [&](int a, int b) {
    while (next < present.size() && std::pair(present[next].row, present[next].column) <= std::pair(a, b))
      sum.off_diagonal.push_back(present[next++]);
  };
  for (std::size_t k = 0; k < states_.size(); ++k) {
    const IncipientContact& pair = second_.pairs[k];
    const State& state = states_[k];
    if (!touching(pair) && !state.closing) continue;
    copy_up_to(pair.a, pair.b);
    std::vector<BlockMatrix::Block>& blocks = sum.off_diagonal;
    if (blocks.empty() || blocks.back().row != pair.a || blocks.back().column != pair.b)
      blocks.push_back({pair.a, pair.b, Matrix6d::Zero()});
    if (state.closing) {
      const LinearisedOverlap& closed = pair.closed;
      sum.diagonal[pair.a] += closed.slope_a * closed.slope_a.transpose() / 2;
      sum.diagonal[pair.b] += closed.slope_b * closed.slope_b.transpose() / 2;
      blocks.back().value += closed.slope_a * closed.slope_b.transpose() / 2;
      if (sum.strains() > 0) {
        sum.border.middleRows<6>(6 * pair.a) += closed.slope_a * closed.slope_strains.transpose() / 2;
        sum.border.middleRows<6>(6 * pair.b) += closed.slope_b * closed.slope_strains.transpose() / 2;
        sum.corner += closed.slope_strains * closed.slope_strains.transpose() / 2;
      }
    }
    add_tilt(tilt_weight(pair, state, shift), pair, sum, blocks.back());
  }
  return sum;
}

/// The matrix has gained terms u uᵀ since the pairs were in the states `before`. Returns the vectors u as columns, or
/// nullopt if a term was removed or too many terms were added.
std::optional<Eigen::MatrixXd> StepModel::gained(const std::vector<State>& before, double shift) const {
  std::vector<Eigen::VectorXd> terms;
  const auto most = static_cast<std::size_t>(updates_per_particle * second_.hessian.size());
  for (std::size_t k = 0; k < states_.size(); ++k) {
    const IncipientContact& pair = second_.pairs[k];
    if (before[k].closing && !states_[k].closing) return std::nullopt;
    if (states_[k].closing && !before[k].closing) terms.emplace_back(column(pair, pair.closed) / std::sqrt(2.0));
    const double extra = tilt_weight(pair, states_[k], shift) - tilt_weight(pair, before[k], shift);
    if (extra > 0) {
      for (const Eigen::Vector3d& axis : roots(extra * pair.tilt)) {
        const Vector6d rotation = joined(Eigen::Vector3d::Zero(), axis);
        terms.push_back(column(pair, {0, -rotation, rotation, {}}));
      }
    }
    if (terms.size() > most) return std::nullopt;
  }
  Eigen::MatrixXd u(gradient_.size(), static_cast<Eigen::Index>(terms.size()));
  for (std::size_t t = 0; t < terms.size(); ++t) u.col(static_cast<Eigen::Index>(t)) = terms[t];
  return u;
}

/// Slopes of a linearised overlap with respect to all coordinates.
Eigen::VectorXd StepModel::column(const IncipientContact& pair, const LinearisedOverlap& volume) const {
  Eigen::VectorXd u = Eigen::VectorXd::Zero(gradient_.size());
  u.segment<6>(6 * pair.a) = volume.slope_a;
  u.segment<6>(6 * pair.b) = volume.slope_b;
  u.tail(volume.slope_strains.size()) = volume.slope_strains;
  return u;
}

/// Gradient of the model at s = 0, including the energies ¼ closed² of closing pairs.
Eigen::VectorXd StepModel::gradient() const {
  Eigen::VectorXd sum = gradient_;
  for (std::size_t k = 0; k < states_.size(); ++k) {
    if (!states_[k].closing) continue;
    const IncipientContact& pair = second_.pairs[k];
    const LinearisedOverlap& closed = pair.closed;
    sum.segment<6>(6 * pair.a) += closed.at_rest / 2 * closed.slope_a;
    sum.segment<6>(6 * pair.b) += closed.at_rest / 2 * closed.slope_b;
    sum.tail(closed.slope_strains.size()) += closed.at_rest / 2 * closed.slope_strains;
  }
  return sum;
}

/// The decrease of the energy that the model predicts. Tilt terms only shorten the step as a precaution; they do not
/// count.
double StepModel::decrease(const Eigen::VectorXd& step) const {
  double sum = -gradient_.dot(step) - step.dot(second_.hessian * step) / 2;
  for (std::size_t k = 0; k < states_.size(); ++k) {
    if (!states_[k].closing) continue;
    const IncipientContact& pair = second_.pairs[k];
    const double closed = std::max(0.0, pair.closed.at(step, pair.a, pair.b));
    const double now = std::max(0.0, pair.now.at(step, pair.a, pair.b));
    sum -= std::max(0.0, closed * closed - now * now) / 4;
  }
  return sum;
}

std::optional<ModelStep> StepModel::minimise(double shift, StepFactor& factor, ActivePairs& active) {
  recall(active, shift);
  Eigen::VectorXd step;
  std::vector<State> factorised;
  for (int round = 0; round < most_rounds; ++round) {
    const auto update = round > 0 ? gained(factorised, shift) : std::nullopt;
    if (update) {
      ++factor.updates;
      step = -solve_updated(factor.cholesky, *update, gradient());
    } else {
      ++factor.factorisations;
      if (!factor.cholesky.factorise(assembled(shift), shift)) return std::nullopt;
      factorised = states_;
      step = -factor.cholesky.solve(gradient());
    }
    step *= std::min(1.0, longest_ / largest_displacement(step));
    if (!revise(step, shift, round < releasing_rounds)) break;
  }
  active = active_pairs(step);
  return ModelStep{step, decrease(step)};
}

}  // namespace isojam
