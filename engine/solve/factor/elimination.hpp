#pragma once

#include <vector>

#include "engine/packing/block_matrix.hpp"

namespace isojam {

/// Particles eliminated together: places first … first + columns − 1 of the elimination order.
struct Supernode {
  int first = 0, columns = 0;
  std::vector<int> rows;      ///< later places that they couple to, directly or by fill-in; ascending
  std::vector<int> children;  ///< supernodes whose first row is one of these columns; ascending
};

/// Order in which a Cholesky factorisation eliminates the particles, and what it does at each step.
struct Elimination {
  std::vector<int> node_of;           ///< particle at each place
  std::vector<Supernode> supernodes;  ///< children before parents, in order of `first`
};

/// Plans the elimination for the pattern of `matrix` in about this order of its particles; a function of the pattern
/// and the order alone.
Elimination plan_elimination(const BlockMatrix& matrix, const std::vector<int>& order);

}  // namespace isojam
