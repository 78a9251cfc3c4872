#pragma once

#include <Eigen/Core>
#include <vector>

#include "engine/geometry/overlap/overlap.hpp"

namespace isojam {

/// Symmetric matrix that consists of 6×6 blocks: one diagonal block per particle and one off-diagonal block per pair of
/// touching particles. If strains of the cell are also coordinates, the matrix has additional rows and columns for the
/// strains: `border` and `corner`.
struct BlockMatrix {
  /// An off-diagonal block.
  struct Block {
    int row = 0, column = 0;  ///< position of the block, row < column; the block at (column, row) is its transpose
    Matrix6d value;           ///< entries for the coordinates (x, R·θ) of the particles `row` and `column`
  };
  std::vector<Matrix6d> diagonal;  ///< diagonal block of every particle
  /// blocks above the diagonal, sorted by (row, column); at most one block per position
  std::vector<Block> off_diagonal;
  /// `border` has the rows of the particles and the columns of the strains, 6N × strains. `corner` has the rows and
  /// columns of the strains, strains × strains. Both are empty if no strain is a coordinate.
  Eigen::MatrixXd border, corner;
  /// √m of each particle with the mass m, if the coordinates are multiplied by √m and the masses differ; otherwise
  /// empty. In these coordinates, the entries of a uniform translation are proportional to √m.
  Eigen::VectorXd root_masses{};

  int size() const { return static_cast<int>(diagonal.size()); }   ///< number of diagonal blocks
  int strains() const { return static_cast<int>(corner.cols()); }  ///< number of strains that are coordinates
  /// Number of rows: 6N plus the number of strains.
  Eigen::Index rows() const { return 6 * Eigen::Index{size()} + strains(); }
  /// Adds the blocks of a pair of particles, row < column. Successive calls must be sorted by (row, column), and
  /// several may have the same row and column.
  void add_pair(int row, int column, const Matrix6d& row_row, const Matrix6d& row_column,
                const Matrix6d& column_column);
  /// Adds a matrix with the same numbers of blocks and strains.
  BlockMatrix& operator+=(const BlockMatrix& term);
};

/// Product of the matrix with a vector of matrix.rows() entries.
Eigen::VectorXd operator*(const BlockMatrix& matrix, const Eigen::VectorXd& x);

}  // namespace isojam
