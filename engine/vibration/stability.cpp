#include "engine/vibration/stability.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>

#include "engine/solve/factor/dense.hpp"
#include "engine/solve/factor/shift_invert.hpp"
#include "engine/vibration/dynamical_matrix.hpp"
#include "engine/vibration/pinned_matrix.hpp"

namespace isojam {

namespace {

/// Number of eigenvalues of D below σ. nullopt if σ is an eigenvalue or D is not finite.
std::optional<int> count_below(const BlockMatrix& matrix, double sigma) {
  ShiftInvert inverse(matrix);
  try {
    inverse.set_shift(sigma);
  } catch (const std::domain_error&) {
    return std::nullopt;
  }
  return inverse.negative_pivots();
}

bool all_above(const BlockMatrix& matrix, double sigma) { return BlockCholesky().factorise(matrix, -sigma); }

void count_modes(const BlockMatrix& matrix, double lambda_max, Stability& stability) {
  const auto all = static_cast<int>(matrix.rows());
  const double tolerance = stability.tolerance;
  // Pinning one particle removes three dimensions. The smallest eigenvalue of the rest is at most the fourth eigenvalue
  // of D. The first three eigenvalues of D belong to the translations.
  if (all_above(pinned_matrix(matrix, lambda_max, Pinning::translations), tolerance)) {
    stability.zero = 3;
    stability.positive = all - 3;
    stability.verdict = Verdict::stable;
    return;
  }
  const std::optional<int> negative = count_below(matrix, -tolerance), not_positive = count_below(matrix, tolerance);
  if (!negative || !not_positive) {
    stability.verdict = Verdict::undetermined;
    return;
  }
  stability.negative = *negative;
  stability.zero = *not_positive - *negative;
  stability.positive = all - *not_positive;
  stability.verdict = *negative > 0 ? Verdict::unstable : (stability.zero > 3 ? Verdict::marginal : Verdict::stable);
}

std::vector<int> contacts_of(const BlockMatrix& matrix) {
  std::vector<int> contacts(matrix.diagonal.size(), 0);
  for (const BlockMatrix::Block& block : matrix.off_diagonal) {
    ++contacts[block.row];
    ++contacts[block.column];
  }
  return contacts;
}

/// Marks the particles with more than half of the squared amplitude of a mode with λ at or below the tolerance.
std::vector<char> carriers(const ModeSet& modes, double tolerance, int particles) {
  std::vector<char> carries(static_cast<std::size_t>(particles), 0);
  for (Eigen::Index k = 0; k < modes.size() && modes.eigenvalues[k] <= tolerance; ++k) {
    for (int i = 0; i < particles; ++i) {
      if (modes.vectors.col(k).segment<6>(6 * i).squaredNorm() > 0.5) carries[i] = 1;
    }
  }
  return carries;
}

std::vector<NearRattler> find_near_rattlers(const BlockMatrix& matrix, const ModeSet& lowest, double tolerance) {
  const std::vector<int> contacts = contacts_of(matrix);
  const std::vector<char> carries = carriers(lowest, tolerance, matrix.size());
  std::vector<NearRattler> found;
  for (int i = 0; i < matrix.size(); ++i) {
    const double least_eigenvalue = symmetric_eigenvalues(matrix.diagonal[i])[0];
    const bool few = contacts[i] < 4;
    if (!few && least_eigenvalue > tolerance && !carries[i]) continue;
    using enum NearRattler::Reason;
    found.push_back({i, few ? few_contacts : vanishing_stiffness, contacts[i], least_eigenvalue});
  }
  return found;
}

}  // namespace

double zero_tolerance(const BlockMatrix& matrix, double lambda_max, double unbalanced_torque) {
  return rounding_bound(matrix, lambda_max) + unbalanced_torque;
}

double unbalanced_torque(const Evaluation& evaluation, const Composition& solids) {
  double largest = 0;
  for (Eigen::Index k = 3; k < evaluation.gradient.size(); k += 6)
    largest = std::max(largest, evaluation.gradient.segment<3>(k).norm() / solids[k / 6].gyration_radius());
  return largest;
}

Stability assess(const BlockMatrix& matrix, const SpectrumEnds& ends, double unbalanced_torque) {
  Stability stability;
  const double bound = norm_bound(matrix);
  if (!std::isfinite(bound)) {
    stability.verdict = Verdict::undetermined;
    return stability;
  }
  // If the highest modes are unknown, λ_max is replaced by an upper bound.
  const double lambda_max = ends.lambda_max > 0 ? ends.lambda_max : bound;
  if (lambda_max == 0) {
    stability.zero = static_cast<int>(matrix.rows());
    stability.verdict = Verdict::marginal;
  } else {
    stability.tolerance = zero_tolerance(matrix, lambda_max, unbalanced_torque);
    count_modes(matrix, lambda_max, stability);
    Eigen::MatrixXd moves = Eigen::MatrixXd::Zero(matrix.rows(), 3);
    moves.topRows(6 * Eigen::Index{matrix.size()}) = translations(matrix);
    for (int c = 0; c < 3; ++c)
      stability.translation_error = std::max(stability.translation_error, (matrix * moves.col(c)).norm());
  }
  stability.near_rattlers = find_near_rattlers(matrix, ends.lowest, stability.tolerance);
  return stability;
}

}  // namespace isojam
