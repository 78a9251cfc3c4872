#pragma once

#include <vector>

#include "engine/packing/block_matrix.hpp"

namespace isojam {

/// A supernode: particles that are eliminated together. They have the positions first … first + columns − 1 in the
/// elimination order.
struct Supernode {
  int first = 0, columns = 0;
  std::vector<int> rows;      ///< later positions to which these particles couple, directly or by fill-in; ascending
  std::vector<int> children;  ///< indices of the supernodes whose first row is one of these columns; ascending
};

/// The order in which a Cholesky factorisation eliminates the particles, and the supernodes.
struct Elimination {
  std::vector<int> node_of;           ///< index of the particle at each position
  std::vector<Supernode> supernodes;  ///< children before parents, sorted by `first`
};

/// Plans the elimination for the pattern of `matrix`, close to the given order of its particles. The result depends
/// only on the pattern and the order.
Elimination plan_elimination(const BlockMatrix& matrix, const std::vector<int>& order);

}  // namespace isojam
