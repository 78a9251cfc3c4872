#include "engine/rigidity/rigidity.hpp"

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <algorithm>
#include <cassert>
#include <cmath>
#include <iterator>
#include <limits>
#include <map>
#include <stdexcept>
#include <utility>

#include "engine/packing/block_matrix.hpp"
#include "engine/random/stream.hpp"
#include "engine/solve/factor/block_cholesky.hpp"
#include "engine/solve/factor/dense.hpp"

namespace isojam {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

using RowMajor = Eigen::SparseMatrix<double, Eigen::RowMajor>;

/// The entries of a row, six for each of its particles.
std::map<int, Vector6d> by_particle(const RowMajor& rows, Index row) {
  std::map<int, Vector6d> parts;
  for (RowMajor::InnerIterator entry(rows, row); entry; ++entry) {
    const auto [part, first] = parts.try_emplace(static_cast<int>(entry.col() / 6), Vector6d::Zero());
    part->second[entry.col() % 6] = entry.value();
  }
  return parts;
}

double largest_row_sum(const BlockMatrix& matrix) {
  Eigen::VectorXd sums(6 * matrix.size());
  for (int i = 0; i < matrix.size(); ++i)
    sums.segment<6>(6 * i) = matrix.diagonal[static_cast<std::size_t>(i)].cwiseAbs().rowwise().sum();
  for (const auto& block : matrix.off_diagonal) {
    sums.segment<6>(6 * block.row) += block.value.cwiseAbs().rowwise().sum();
    sums.segment<6>(6 * block.column) += block.value.cwiseAbs().colwise().sum().transpose();
  }
  return sums.maxCoeff();
}

/// The Gram matrix rowsᵀrows. Rows have 6N entries.
BlockMatrix gram(const Eigen::SparseMatrix<double>& rows) {
  assert(rows.cols() % 6 == 0);
  BlockMatrix matrix;
  matrix.diagonal.assign(static_cast<std::size_t>(rows.cols() / 6), Matrix6d::Zero());
  std::map<std::pair<int, int>, Matrix6d> pairs;
  const RowMajor in_rows = rows;
  for (Index row = 0; row < in_rows.rows(); ++row) {
    const auto parts = by_particle(in_rows, row);
    for (auto a = parts.begin(); a != parts.end(); ++a) {
      matrix.diagonal[static_cast<std::size_t>(a->first)] += a->second * a->second.transpose();
      for (auto b = std::next(a); b != parts.end(); ++b)
        pairs.try_emplace({a->first, b->first}, Matrix6d::Zero()).first->second += a->second * b->second.transpose();
    }
  }
  for (const auto& [pair, value] : pairs) matrix.off_diagonal.push_back({pair.first, pair.second, value});
  return matrix;
}

/// Inverse iteration with rows·rowsᵀ, where `rows` is RigidityMatrix::rows. It finds the combinations of constraints
/// with the smallest singular values. It uses a sparse factorisation of rowsᵀrows + τ²·1 in 6×6 blocks, one block row
/// per particle; damped() defines τ. For N = 400 this takes milliseconds; a dense factorisation would take half a
/// minute.
class SoftRows {
 public:
  /// Stores a reference to `rows`, constraints × 6N, which must outlive this object. Throws std::invalid_argument if
  /// `rows` contains NaN or infinity.
  explicit SoftRows(const Eigen::SparseMatrix<double>& rows);

  /// One step of the iteration for each column of x (Sherman, Morrison, Woodbury):
  ///   τ² (rows rowsᵀ + τ²)⁻¹ x = x − rows (rowsᵀrows + τ²)⁻¹ rowsᵀ x
  /// A combination whose singular value is σ is multiplied by τ²/(σ² + τ²). States of self-stress (σ = 0) therefore do
  /// not change, and all other combinations are damped. τ is 1e-6 times stiffest().
  Eigen::MatrixXd damped(const Eigen::MatrixXd& x) const;

  /// An upper bound of the largest singular value: the square root of the largest row sum of |rowsᵀrows|.
  double stiffest() const { return stiffest_; }

 private:
  BlockCholesky factor_;
  const Eigen::SparseMatrix<double>& rows_;
  double stiffest_ = 0;
};

SoftRows::SoftRows(const Eigen::SparseMatrix<double>& rows) : rows_(rows) {
  const BlockMatrix matrix = gram(rows);
  const double scale = largest_row_sum(matrix);
  stiffest_ = std::sqrt(scale);
  // Rounding errors are 1e-16 of the scale. They can make a singular matrix indefinite by a few times this, but not by
  // 1e-12.
  if (!std::isfinite(scale) || !factor_.factorise(matrix, 1e-12 * scale))
    throw std::invalid_argument("constraints that are not finite have no rank");
}

Eigen::MatrixXd SoftRows::damped(const Eigen::MatrixXd& x) const {
  Eigen::MatrixXd result = x;
  for (Index k = 0; k < x.cols(); ++k) {
    const Eigen::VectorXd image = rows_.transpose() * x.col(k);
    result.col(k) -= rows_ * factor_.solve(image);
  }
  return result;
}

constexpr double epsilon = std::numeric_limits<double>::epsilon();

/// `spare` directions are computed in addition to the states of self-stress that must exist for this number of rows. At
/// least `least_beyond` of all directions must have a nonzero singular value; otherwise the number of directions is
/// doubled. More directions make the smallest nonzero singular value more accurate.
constexpr Index spare = 12, least_beyond = 6;
/// Rounds of damping. One round multiplies a part with the singular value σ > 0 by about τ²/σ², which is 1e-6 or less
/// in packings. After three rounds only rounding errors of such parts remain, and the singular values nearest to zero
/// are resolved.
constexpr int rounds = 3;

/// Orthonormal combinations of the rows. Their singular values are those of rowsᵀ·combinations, in descending order.
struct SoftSpace {
  MatrixXd combinations;  ///< constraints × k
  VectorXd sigma;         ///< k, descending
};

/// Rayleigh–Ritz method with the singular values of rowsᵀ·Q. The eigenvalues of rows·rowsᵀ would not resolve small
/// singular values.
SoftSpace diagonalised(const RigidityMatrix& matrix, const MatrixXd& q) {
  const MatrixXd image = matrix.rows.transpose() * q;
  const Index k = q.cols();
  SoftSpace space;
  if (image.rows() < k) {
    const RightSingular svd = right_singular(image);
    space.sigma = VectorXd::Zero(k);
    space.sigma.head(svd.values.size()) = svd.values;
    space.combinations = q * svd.vectors;
    return space;
  }
  const RightSingular svd = right_singular(triangular_factor(image));
  space.sigma = svd.values;
  space.combinations = q * svd.vectors;
  return space;
}

/// The k combinations with the smallest singular values, or all combinations if there are at most k.
SoftSpace softest(const RigidityMatrix& matrix, const SoftRows& soft, Index k) {
  const Index constraints = matrix.rows.rows();
  if (k >= constraints) return diagonalised(matrix, MatrixXd::Identity(constraints, constraints));
  RandomStream random{static_cast<std::uint64_t>(constraints), static_cast<std::uint64_t>(k)};
  MatrixXd q(constraints, k);
  for (double& entry : q.reshaped()) entry = random.uniform() - 0.5;
  for (int round = 0; round < rounds; ++round) q = orthonormal(soft.damped(q));
  return diagonalised(matrix, q);
}

/// Counts the singular values that are zero. `sigma` has the smallest of them in descending order, and `all` is the
/// number of all that can differ from zero. Returns the number of zeros in `sigma`.
Index count(Rigidity& result, const VectorXd& sigma, Index all, Index coordinates) {
  const Index dropped = (sigma.array() <= result.tolerance).count(), kept = sigma.size() - dropped;
  result.rank = static_cast<int>(all - dropped);
  result.self_stress = result.constraints - result.rank;
  result.floppy = static_cast<int>(coordinates) - result.rank;
  result.least_kept = kept > 0 ? sigma[kept - 1] : 0;
  result.largest_dropped = dropped > 0 ? sigma[kept] : 0;
  return dropped;
}

}  // namespace

Rigidity analyse_rigidity(const RigidityMatrix& matrix, const RigidityOptions& options) {
  const Index constraints = matrix.rows.rows(), coordinates = matrix.rows.cols();
  Rigidity result;
  result.constraints = static_cast<int>(constraints);
  result.floppy = static_cast<int>(coordinates);
  if (constraints == 0) return result;
  const SoftRows soft(matrix.rows);
  const double rounding = static_cast<double>(std::max(constraints, coordinates)) * epsilon * soft.stiffest();
  result.tolerance =
      matrix.imbalance > options.balanced ? rounding : std::max(rounding, options.margin * matrix.imbalance);
  result.tolerance = std::max(result.tolerance, options.least_tolerance);
  const Index least = std::max<Index>(0, constraints - (coordinates - 3)) + spare;
  // With so many states of self-stress, all singular values together cost less.
  if (constraints >= coordinates && least > coordinates && !options.stresses) {
    count(result, singular_values_of(triangular_factor(MatrixXd(matrix.rows))), coordinates, coordinates);
    return result;
  }
  SoftSpace space;
  for (Index k = least;; k *= 2) {
    space = softest(matrix, soft, k);
    const Index dropped = count(result, space.sigma, constraints, coordinates);
    if (options.stresses) result.stresses = space.combinations.rightCols(dropped);
    // Translations are always floppy. A higher rank means that directions with a singular value of zero are missing.
    const bool enough = space.sigma.size() - dropped >= least_beyond && result.rank <= coordinates - 3;
    if (enough || space.sigma.size() == constraints) return result;
  }
}

}  // namespace isojam
