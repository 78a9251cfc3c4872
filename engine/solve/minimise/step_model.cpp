#include "engine/solve/minimise/step_model.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/solve/factor/low_rank_update.hpp"
#include "engine/solve/minimise/descent.hpp"

// Near jamming the series E + g·s + ½ s·H s holds only for steps up to the depth of a flat contact, 1e-10 or less. Two
// effects occur earlier: pairs close, and flat contacts tilt until their section line crosses the face. The model of a
// pair has a spring for each. V of a touching corner whose face is about to become coplanar with the other body's face:
//
//    V |                                 *
//      |                                * closed: tangent with the gap closed
//      |                               *
//      |                              *   . . . . now: present tangent
//      |                          * *.
//      |                  * * * *   .
//      |          * * * *          .
//      |  * * * *                 .
//    0 +-------------------------.-------------------------> step, here an approach
//      |                        .
//
// The model is V = max(0, now, closed), drawn with *. It is a lower bound, because V of a flat contact is convex. If
// the pair does not touch, now = 0.
//
//   incipient contact    A pair that touches, or would touch with centres closer by the probe distance, a fraction of
//                        the last step (incipient_contact.hpp). The model ignores pairs that are farther apart.
//   linearised overlap   V to first order in s, at_rest + slope·s. A pair has two: now and closed.
//   tilt term            ½ τ·Tτ, τ the relative rotation: the stiffness of a flat contact after its section line
//                        crosses the face. Before that V is linear in the rotation, so that H lacks this stiffness.
//   active set           Pairs that the step closes, closed > max(0, now): they have the spring ¼ closed², which adds
//                        ½ ∇V ∇Vᵀ to H. And pairs that it tilts too far for their energy: they have a fraction w of T.
//   shift The Levenberg–Marquardt μ, the same for every coordinate. For larger μ more contacts have their
//                        tilt term, and pairs whose spring is softer than μ need not close in the model.
//
// The step is the zero of the gradient of g·s + ½ s·(H + μ)s + Σ_closing ¼ closed² + Σ ½ w τ·Tτ, which is a linear
// system. The active set and s depend on each other, so the two are alternated for a few iterations. In the predicted
// decrease each spring costs ¼ (closed² − now²). Tilt terms and shift are a precaution and are not counted.
//
// The constants below were measured for packings of 100 octahedra and tetrahedra at φ − φ_J = 0.02 … 0.004 after an
// affine strain step. Changing any of them by a factor of three changes the number of evaluations to equilibrium by
// less than a fifth.

namespace isojam {

namespace {

/// Rounds of the active-set iteration that may release pairs. Later rounds only add pairs, so that the iteration ends.
constexpr int releasing_rounds = 2;

/// Tilt term of a contact that the step tilts, in units of its stiffness when the section line crosses its centre.
/// Elsewhere the resistance is smaller.
constexpr double tilted = 0.1;

/// A contact counts as tilted if the step would store at least the fraction `tilt_onset` of its energy in tilt. Below
/// `tilt_release` it is not in the next initial estimate.
constexpr double tilt_onset = 0.5, tilt_release = 0.05;

/// If the shift is at least this fraction of the largest diagonal entry of H, all contacts have the full tilt term;
/// below it, a part.
constexpr double stiffened_at = 1e-6;

/// Later rounds update the factors of the first round by up to this many terms per particle. A factorisation costs as
/// much as that many solves (17 for N = 100, 55 for N = 400).
constexpr double updates_per_particle = 1.0 / 6;

/// The tangent with the gap closed matters only if its squared slope is this many times that of the present one.
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

/// The vectors v of S = Σ v vᵀ.
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

/// True if the tangent with the gap closed can matter. It cannot if the shift is stiffer than the pair.
bool StepModel::may_close(const IncipientContact& pair, double shift) const {
  const double closed = squared_norm(pair.closed);
  return closed > 2 * shift && closed >= steeper * squared_norm(pair.now);
}

/// Returns true if some pair changed its state.
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

/// Fraction of its tilt term that a pair has.
double StepModel::tilt_weight(const IncipientContact& pair, const State& state, double shift) const {
  if (!touching(pair) && !state.closing) return 0;
  const double everywhere = std::min(1.0, shift / (stiffened_at * largest_diagonal_));
  return std::max(everywhere, state.tilted ? tilted : 0.0);
}

/// H with the springs ½ ∇V ∇Vᵀ of closing pairs, and the tilt terms.
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

/// The vectors u of the terms u uᵀ that were added to the matrix since the pairs were in the states `before`, as
/// columns. Returns nullopt if a term was removed or too many were added.
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

/// Slopes with respect to all coordinates.
Eigen::VectorXd StepModel::column(const IncipientContact& pair, const LinearisedOverlap& volume) const {
  Eigen::VectorXd u = Eigen::VectorXd::Zero(gradient_.size());
  u.segment<6>(6 * pair.a) = volume.slope_a;
  u.segment<6>(6 * pair.b) = volume.slope_b;
  u.tail(volume.slope_strains.size()) = volume.slope_strains;
  return u;
}

/// Gradient of the model at s = 0, with the springs of closing pairs.
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

/// Tilt terms are a precaution: they shorten the step and are not counted.
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
