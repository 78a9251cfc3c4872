#include "engine/rigidity/rigidity.hpp"

#include <algorithm>
#include <limits>

#include "engine/random/stream.hpp"
#include "engine/rigidity/soft_rows.hpp"
#include "engine/solve/factor/dense.hpp"

namespace isojam {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

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
    if (space.sigma.size() - dropped >= least_beyond || space.sigma.size() == constraints) return result;
  }
}

}  // namespace isojam
