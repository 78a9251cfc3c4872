#pragma once

#include <Eigen/Core>
#include <cmath>

#include "engine/packing/block_matrix.hpp"
#include "engine/random/stream.hpp"

namespace isojam {

/// A matrix for n points at random positions in a periodic cube. A random block couples each point to each of about ten
/// near points. With a shift of `safe_shift` the matrix is positive definite.
inline BlockMatrix scattered_blocks(int n, std::uint64_t seed) {
  RandomStream random{seed, static_cast<std::uint64_t>(n)};
  Eigen::Matrix3Xd points(3, n);
  for (double& x : points.reshaped()) x = random.uniform();
  const double reach = std::cbrt(10.0 / n * 3 / (4 * 3.14159265));
  BlockMatrix matrix;
  matrix.diagonal.assign(static_cast<std::size_t>(n), Matrix6d::Identity());
  for (int i = 0; i < n; ++i) {
    for (int j = i + 1; j < n; ++j) {
      Eigen::Vector3d r = points.col(j) - points.col(i);
      r.array() -= r.array().round();
      if (r.norm() > reach) continue;
      Matrix6d block;
      for (double& entry : block.reshaped()) entry = random.uniform() - 0.5;
      matrix.off_diagonal.push_back({i, j, block});
    }
  }
  return matrix;
}

/// Rows with about 60 random entries of variance 1/12 give eigenvalues between about −5 and 5.
inline constexpr double safe_shift = 10;

}  // namespace isojam
