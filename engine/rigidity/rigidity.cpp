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

/// Number of directions beyond those that must be soft, and minimum number of them that must turn out not to be. More
/// directions make the smallest nonzero singular value more accurate.
constexpr Index spare = 12, least_beyond = 6;
/// Rounds of damping. One round divides the part with singular value σ by σ²/τ², 1e6 and more in packings. After three
/// only rounding is left, and the singular values nearest to zero are resolved.
constexpr int rounds = 3;

/// Orthonormal combinations of the rows, softest last, and their singular values, which are those of
/// rowsᵀ·combinations.
struct SoftSpace {
  MatrixXd combinations;  ///< constraints × k
  VectorXd sigma;         ///< k, descending
};

/// Rayleigh–Ritz by the singular values of rowsᵀ·Q. The eigenvalues of rows·rowsᵀ would not resolve small ones.
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

/// The k softest combinations, or all if there are at most k.
SoftSpace softest(const RigidityMatrix& matrix, const SoftRows& soft, Index k) {
  const Index constraints = matrix.rows.rows();
  if (k >= constraints) return diagonalised(matrix, MatrixXd::Identity(constraints, constraints));
  RandomStream random{static_cast<std::uint64_t>(constraints), static_cast<std::uint64_t>(k)};
  MatrixXd q(constraints, k);
  for (double& entry : q.reshaped()) entry = random.uniform() - 0.5;
  for (int round = 0; round < rounds; ++round) q = orthonormal(soft.damped(q));
  return diagonalised(matrix, q);
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
  SoftSpace space;
  Index dropped = 0;
  for (Index k = std::max<Index>(0, constraints - (coordinates - 3)) + spare;; k *= 2) {
    space = softest(matrix, soft, k);
    dropped = (space.sigma.array() <= result.tolerance).count();
    if (space.sigma.size() - dropped >= least_beyond || space.sigma.size() == constraints) break;
  }
  const Index kept = space.sigma.size() - dropped;
  result.self_stress = static_cast<int>(dropped);
  result.rank = static_cast<int>(constraints - dropped);
  result.floppy = static_cast<int>(coordinates) - result.rank;
  if (kept > 0) result.least_kept = space.sigma[kept - 1];
  if (dropped > 0) result.largest_dropped = space.sigma[kept];
  if (options.stresses) result.stresses = space.combinations.rightCols(dropped);
  return result;
}

}  // namespace isojam
