#include "engine/solve/minimise/step_model.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/solve/factor/low_rank_update.hpp"
#include "engine/solve/minimise/descent.hpp"

// Near jamming the series E + g·s + ½ s·H s holds for steps no longer than a flat contact is deep, 1e-10 and less. Two
// things happen sooner: pairs close, and flat contacts tilt until their section line cuts the face. The model of a pair
// has a spring for either. V of a corner that touches, its face about to come flush with the other's:
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
// drawn with *: V = max(0, now, closed), from below, V of a flat contact being convex. Of a pair still apart, now = 0.
//
//   incipient contact    A pair that touches, or would with centres closer by the probe distance, a part of the last
//                        step (incipient_contact.hpp). The model knows nothing of pairs farther apart.
//   linearised overlap   V to first order in s, at_rest + slope·s. A pair has two: now and closed.
//   tilt term            ½ τ·Tτ, τ the relative turn: the stiffness that a flat contact has once its section line cuts
//                        the face. Until then V is linear in the turn, and H does not know of it.
//   active set           Pairs that the step closes, closed > max(0, now): they have the spring ¼ closed², which adds
//                        ½ ∇V ∇Vᵀ to H. And pairs that it tilts too far for their energy: they have a share w of T.
//   shift                μ of Levenberg and Marquardt, the same on every coordinate. As it grows all contacts come to
//                        have their tilt term, and pairs whose spring is softer than μ need not close in the model.
//
// The step is where the gradient of g·s + ½ s·(H + μ)s + Σ_closing ¼ closed² + Σ ½ w τ·Tτ vanishes, a linear system;
// the active set depends on s and s on the active set, so they are found by turns, cut short after a few rounds. From
// the decrease that is promised the springs take ¼ (closed² − now²); tilt terms and shift are caution and take nothing.
//
// The constants below were measured on packings of 100 octahedra and tetrahedra between φ − φ_J = .02 and .004,
// starting from an affine strain step: evaluations to equilibrium change by less than a fifth over a factor of three in
// each.

namespace isojam {

namespace {

/// Of the rounds of the active-set iteration; in later ones pairs are added and none released, so that it ends.
constexpr int releasing_rounds = 2;

/// The tilt term of a contact that the step tilts, in units of its stiffness when half cut. A contact that is cut
/// elsewhere resists less.
constexpr double tilted = 0.1;

/// A contact counts as tilted by a step that would store this fraction of its energy in tilt, and is no longer guessed
/// to be below the second.
constexpr double tilt_onset = 0.5, tilt_release = 0.05;

/// All contacts have the tilt term once the shift reaches this fraction of the largest diagonal entry of H, and part of
/// it below.
constexpr double stiffened_at = 1e-6;

/// Later rounds update the factors of the first by up to this many terms per particle instead of factorising anew: a
/// factorisation costs as much as that many solves (17 at N = 100, 55 at N = 400).
constexpr double updates_per_particle = 1.0 / 6;

/// The tangent with the gap closed matters only where it is this many times as steep (squared) as the present one.
constexpr double steeper = 2;

double tilt_energy(const IncipientContact& pair, const Eigen::VectorXd& step) {
  const Eigen::Vector3d tilt = pair.relative_turn(step);
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
  matrix.diagonal[block.row].bottomRightCorner<3, 3>() += pair.turn_a * pair.turn_a * stiffness;
  matrix.diagonal[block.column].bottomRightCorner<3, 3>() += pair.turn_b * pair.turn_b * stiffness;
  block.value.bottomRightCorner<3, 3>() -= pair.turn_a * pair.turn_b * stiffness;
}

/// The v of S = Σ v vᵀ.
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

/// Whether the tangent with the gap closed can matter. Next to a shift that is stiffer than the pair it cannot.
bool StepModel::may_close(const IncipientContact& pair, double shift) const {
  const double closed = squared_norm(pair.closed);
  return closed > 2 * shift && closed >= steeper * squared_norm(pair.now);
}

/// True if some pair changed its state.
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

/// How much of its tilt term a pair has.
double StepModel::tilt_weight(const IncipientContact& pair, const State& state, double shift) const {
  if (!touching(pair) && !state.closing) return 0;
  const double everywhere = std::min(1.0, shift / (stiffened_at * largest_diagonal_));
  return std::max(everywhere, state.tilted ? tilted : 0.0);
}

/// H with the springs ½ ∇V ∇Vᵀ of closing pairs and the tilt terms.
BlockMatrix StepModel::assembled(double shift) const {
  const std::vector<BlockMatrix::Block>& present = second_.hessian.off_diagonal;
  BlockMatrix sum;
  sum.diagonal = second_.hessian.diagonal;
  sum.border = second_.hessian.border;
  sum.corner = second_.hessian.corner;
  std::size_t next = 0;
  // Pairs come in the order of blocks: two sorted lists become one.
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

/// u of the terms u uᵀ that the matrix has gained since the pairs were in the states `before`, as columns. nullopt if
/// it lost one, or gained too many.
std::optional<Eigen::MatrixXd> StepModel::gained(const std::vector<State>& before, double shift) const {
  std::vector<Eigen::VectorXd> terms;
  const auto most = static_cast<std::size_t>(updates_per_particle * second_.hessian.size());
  for (std::size_t k = 0; k < states_.size(); ++k) {
    const IncipientContact& pair = second_.pairs[k];
    if (before[k].closing && !states_[k].closing) return std::nullopt;
    if (states_[k].closing && !before[k].closing) terms.emplace_back(column(pair, pair.closed) / std::sqrt(2.0));
    const double extra = tilt_weight(pair, states_[k], shift) - tilt_weight(pair, before[k], shift);
    if (extra > 0) {
      for (const Eigen::Vector3d& turn : roots(extra * pair.tilt)) {
        const Vector6d turned = joined(Eigen::Vector3d::Zero(), turn);
        terms.push_back(column(pair, {0, -turned, turned, {}}));
      }
    }
    if (terms.size() > most) return std::nullopt;
  }
  Eigen::MatrixXd u(gradient_.size(), static_cast<Eigen::Index>(terms.size()));
  for (std::size_t t = 0; t < terms.size(); ++t) u.col(static_cast<Eigen::Index>(t)) = terms[t];
  return u;
}

/// Slopes by all coordinates.
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

/// Tilt terms are caution, not expectation: they shorten the step and are not counted.
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
