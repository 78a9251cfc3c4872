#pragma once

#include <Eigen/Core>
#include <vector>

#include "engine/geometry/overlap/overlap.hpp"

namespace isojam {

/// Symmetric matrix of 6×6 blocks: one per particle and one per pair of touching particles. If strains of the cell are
/// coordinates too, it has a border for them.
struct BlockMatrix {
  /// An off-diagonal block.
  struct Block {
    int row = 0, column = 0;  ///< row < column; the block below the diagonal is its transpose
    Matrix6d value;           ///< 6 × 6, per particle (x, R·θ)
  };
  std::vector<Matrix6d> diagonal;   ///< diagonal block of every particle
  std::vector<Block> off_diagonal;  ///< sorted by (row, column), each at most once
  /// The last columns, 6N × strains, and their diagonal block, strains × strains; empty without strains.
  Eigen::MatrixXd border, corner;
  /// √m of the particles, if coordinates are scaled by it and masses differ: these are then the entries of a uniform
  /// translation. Otherwise empty.
  Eigen::VectorXd root_masses{};

  int size() const { return static_cast<int>(diagonal.size()); }   ///< number of diagonal blocks
  int strains() const { return static_cast<int>(corner.cols()); }  ///< number of strains in the border
  /// Number of entries of a vector that can be multiplied.
  Eigen::Index rows() const { return 6 * Eigen::Index{size()} + strains(); }
  /// Adds the blocks of a pair of particles, row < column. Calls must be sorted by (row, column); repetitions are
  /// allowed.
  void add_pair(int row, int column, const Matrix6d& row_row, const Matrix6d& row_column,
                const Matrix6d& column_column);
};

/// Product with a vector of matrix.rows() entries.
Eigen::VectorXd operator*(const BlockMatrix& matrix, const Eigen::VectorXd& x);

}  // namespace isojam
