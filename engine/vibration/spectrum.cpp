#include "engine/vibration/spectrum.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "engine/random/stream.hpp"
#include "engine/solve/factor/dense.hpp"
#include "engine/solve/factor/shift_invert.hpp"
#include "engine/vibration/dynamical_matrix.hpp"
#include "engine/vibration/lanczos.hpp"
#include "engine/vibration/lanczos_operators.hpp"

namespace isojam {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double epsilon = std::numeric_limits<double>::epsilon();

/// Sets residual and relative_error.
void judge(ModeSet& modes, const BlockMatrix& matrix, double lambda_max) {
  modes.residual = modes.relative_error = 0;
  for (Index k = 0; k < modes.size(); ++k) {
    const VectorXd u = modes.vectors.col(k);
    const double residual = (matrix * u - modes.eigenvalues[k] * u).norm(), size = std::abs(modes.eigenvalues[k]);
    const double error = residual + epsilon * lambda_max;
    if (lambda_max > 0) modes.residual = std::max(modes.residual, residual / lambda_max);
    modes.relative_error =
        std::max(modes.relative_error, size > 0 ? error / size : std::numeric_limits<double>::infinity());
  }
}

/// Computes modes of an operation, in ascending order. Returns false if the Lanczos method does not converge.
bool take_modes(const BlockMatrix& matrix, LanczosOperation operation, LanczosRequest request, ModeSet& modes) {
  ++modes.attempts;
  request.start = lanczos_start(matrix);
  LanczosModes found = lanczos(std::move(operation), request);
  if (found.ended != LanczosEnd::converged) return false;
  // Spectra may return the eigenvalues in ascending or in descending order.
  modes.eigenvalues = found.eigenvalues.reverse();
  modes.vectors = found.vectors.rowwise().reverse();
  if (modes.eigenvalues.size() > 1 && modes.eigenvalues[0] > modes.eigenvalues[modes.size() - 1]) {
    modes.eigenvalues.reverseInPlace();
    modes.vectors = modes.vectors.rowwise().reverse().eval();
  }
  return modes.eigenvalues.allFinite();
}

/// Dimension of the Krylov space for `wanted` of `all` modes. The second attempt uses a larger space.
Index subspace(Index wanted, Index all, int attempt) {
  const Index spacious = attempt == 0 ? 2 * wanted + 20 : 4 * wanted + 60;
  return std::min(all, spacious);
}

class Ends {
 public:
  Ends(const BlockMatrix& matrix, const ModeOptions& options)
      : matrix_(matrix), options_(options), size_(6 * Index{matrix.size()}), all_(size_ - 3) {}

  SpectrumEnds find() {
    SpectrumEnds ends;
    const double bound = norm_bound(matrix_);
    if (all_ < 1 || !std::isfinite(bound)) {
      ends.lowest.ended = ends.highest.ended = ModeEnd::failed;
      return ends;
    }
    const Index low = std::min<Index>(options_.lowest, all_), high = std::min<Index>(options_.highest, all_);
    const bool iterate = bound > 0 && serves(low) && serves(high);
    if (!iterate || !find_highest(high, ends)) return densely(low, high);
    if (!find_lowest(low, ends)) {
      const SpectrumEnds dense = densely(low, high, ends.lowest.attempts);
      ends.lowest = dense.lowest;
    }
    return ends;
  }

 private:
  /// True if the Lanczos method can compute this number of modes. It needs a space with about twice as many vectors.
  bool serves(Index wanted) const { return wanted > 0 && 2 * wanted + 20 <= all_; }

  bool find_highest(Index wanted, SpectrumEnds& ends) const {
    Product product(matrix_);
    Deflated<Product> operation(product, matrix_);
    for (int attempt = 0; attempt < 2; ++attempt) {
      const LanczosRequest request{.wanted = LanczosWanted::greatest,
                                   .modes = wanted,
                                   .subspace = subspace(wanted, all_, attempt),
                                   .tolerance = options_.highest_tolerance,
                                   .restarts = options_.restarts};
      if (!take_modes(matrix_, LanczosOperation(operation), request, ends.highest)) continue;
      ends.lambda_max = ends.highest.eigenvalues.cwiseAbs().maxCoeff();
      judge(ends.highest, matrix_, ends.lambda_max);
      ends.highest.ended = attempt == 0 ? ModeEnd::converged : ModeEnd::retried;
      return true;
    }
    return false;
  }

  bool find_lowest(Index wanted, SpectrumEnds& ends) const {
    ModeSet& modes = ends.lowest;
    // The first shift is slightly below 0. The second shift is below the whole spectrum, in case there are negative
    // modes.
    for (int attempt = 0; attempt < 2; ++attempt) {
      const double shift = attempt == 0 ? -options_.shift * ends.lambda_max : below_all(ends.lambda_max);
      if (!invert(wanted, attempt, shift, modes)) continue;
      judge(modes, matrix_, ends.lambda_max);
      // The residual ‖Du − λu‖ is at most ‖D − σ‖ times the residual of the eigenpair of the inverse, plus rounding
      // errors.
      const double from_tolerance = options_.lowest_tolerance * (ends.lambda_max - shift);
      if (modes.residual * ends.lambda_max > rounding_bound(matrix_, ends.lambda_max) + from_tolerance) continue;
      modes.ended = attempt == 0 ? ModeEnd::converged : ModeEnd::retried;
      return true;
    }
    return false;
  }

  bool invert(Index wanted, int attempt, double shift, ModeSet& modes) const {
    ShiftInvert inverse(matrix_);
    Deflated<ShiftInvert> operation(inverse, matrix_);
    try {
      const LanczosRequest request{.modes = wanted,
                                   .subspace = subspace(wanted, all_, attempt),
                                   .shift = shift,
                                   .tolerance = options_.lowest_tolerance,
                                   .restarts = options_.restarts};
      if (!take_modes(matrix_, LanczosOperation(operation), request, modes)) return false;
    } catch (const std::domain_error&) {
      return false;  // the shift is an eigenvalue
    }
    return (modes.eigenvalues.array() < shift).count() == inverse.negative_pivots();
  }

  /// A shift below the whole spectrum: below the lowest eigenvalue λ by 2 % of |λ|, or 100 times the shift of the first
  /// attempt if that is lower.
  double below_all(double lambda_max) const {
    Product product(matrix_);
    Deflated<Product> operation(product, matrix_);
    ModeSet lowest;
    const double rough = 1e-2;  // relative to the lowest mode; the shift must only be below it
    const double fallback = -norm_bound(matrix_);
    const LanczosRequest request{.wanted = LanczosWanted::least,
                                 .modes = 1,
                                 .subspace = std::min<Index>(all_, 40),
                                 .tolerance = rough,
                                 .restarts = options_.restarts};
    if (!take_modes(matrix_, LanczosOperation(operation), request, lowest)) return fallback;
    const double lambda = lowest.eigenvalues[0];
    return std::min(-100 * options_.shift * lambda_max, lambda - 2 * rough * std::abs(lambda));
  }

  SpectrumEnds densely(Index low, Index high, int attempts = 0) const {
    SpectrumEnds ends;
    if (matrix_.size() > options_.largest_dense) {
      ends.lowest.ended = ends.highest.ended = ModeEnd::failed;
      ends.lowest.attempts = ends.highest.attempts = attempts;
      return ends;
    }
    const ModeSet all = dense_modes(matrix_);
    ends.lambda_max = all.eigenvalues.cwiseAbs().maxCoeff();
    ends.lowest = part(all, 0, low, ends.lambda_max, attempts);
    ends.highest = part(all, all_ - high, high, ends.lambda_max, attempts);
    return ends;
  }

  ModeSet part(const ModeSet& all, Index first, Index count, double lambda_max, int attempts) const {
    ModeSet modes;
    modes.ended = all.ended == ModeEnd::failed ? ModeEnd::failed : ModeEnd::dense_fallback;
    modes.attempts = attempts + 1;
    modes.eigenvalues = all.eigenvalues.segment(first, count);
    modes.vectors = all.vectors.middleCols(first, count);
    judge(modes, matrix_, lambda_max);
    return modes;
  }

  const BlockMatrix& matrix_;
  const ModeOptions& options_;
  Index size_, all_;
};

}  // namespace

VectorXd lanczos_start(const BlockMatrix& matrix) {
  const Index rows = 6 * Index{matrix.size()};
  RandomStream random{static_cast<std::uint64_t>(rows)};
  VectorXd start(rows);
  for (double& entry : start) entry = random.uniform() - 0.5;
  remove_translations(matrix.root_masses, start);
  return start;
}

SpectrumEnds spectrum_ends(const BlockMatrix& matrix, const ModeOptions& options) {
  return Ends(matrix, options).find();
}

ModeSet dense_modes(const BlockMatrix& matrix) {
  ModeSet modes;
  modes.attempts = 1;
  modes.ended = ModeEnd::failed;
  MatrixXd rotated = dense_matrix(matrix);
  if (rotated.rows() <= 3 || !rotated.allFinite()) return modes;
  // In a basis whose first three vectors are the translations, the other rows and columns of D decouple.
  const CompletedBasis basis(translations(matrix));
  const Index rest = rotated.rows() - 3;
  basis.enter(rotated);
  const SymmetricEigen found = symmetric_eigen(rotated.bottomRightCorner(rest, rest));
  if (found.values.size() == 0) return modes;
  modes.ended = ModeEnd::converged;
  modes.eigenvalues = found.values;
  modes.vectors = MatrixXd::Zero(rotated.rows(), rest);
  modes.vectors.bottomRows(rest) = found.vectors;
  basis.leave(modes.vectors);
  judge(modes, matrix, modes.eigenvalues.cwiseAbs().maxCoeff());
  return modes;
}

}  // namespace isojam
