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
