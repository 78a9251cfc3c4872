#pragma once

#include <Eigen/Core>
#include <vector>

#include "engine/geometry/overlap/overlap.hpp"

namespace isojam {

/// Symmetric matrix of 6×6 blocks, one per particle and one per pair of particles that touch; bordered where strains of
/// the cell are coordinates too.
struct BlockMatrix {
  /// A block beside the diagonal.
  struct Block {
    int row = 0, column = 0;  ///< row < column; the block below the diagonal is its transpose
    Matrix6d value;           ///< 6 × 6, per particle (x, R·θ)
  };
  std::vector<Matrix6d> diagonal;   ///< of every particle with itself
  std::vector<Block> off_diagonal;  ///< in order of (row, column), each at most once
  /// Last columns, 6N × strains, and what stands below them on the diagonal, strains × strains; empty without strains.
  Eigen::MatrixXd border, corner;
  /// √m of the particles, where coordinates are scaled by it and it is not the same for all: a translation of the whole
  /// then has these as its entries. Empty otherwise.
  Eigen::VectorXd root_masses{};

  int size() const { return static_cast<int>(diagonal.size()); }   ///< in blocks
  int strains() const { return static_cast<int>(corner.cols()); }  ///< that border it
  /// Entries of a vector that it multiplies.
  Eigen::Index rows() const { return 6 * Eigen::Index{size()} + strains(); }
  /// Adds the blocks of a pair of particles, row < column; pairs come in order of (row, column), any of them
  /// repeatedly.
  void add_pair(int row, int column, const Matrix6d& row_row, const Matrix6d& row_column,
                const Matrix6d& column_column);
};

/// Product with a vector of matrix.rows() entries.
Eigen::VectorXd operator*(const BlockMatrix& matrix, const Eigen::VectorXd& x);

}  // namespace isojam
