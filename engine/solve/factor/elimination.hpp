#pragma once

#include <vector>

#include "engine/packing/block_matrix.hpp"

namespace isojam {

/// A supernode: particles that are eliminated together. Their number is `columns`. In the elimination order, they have
/// the positions first … first + columns − 1.
struct Supernode {
  int first = 0, columns = 0;
  std::vector<int> rows;      ///< later positions to which the supernode couples, directly or by fill-in; ascending
  std::vector<int> children;  ///< indices of the supernodes whose rows begin with a position of this one; ascending
};

/// The order in which a Cholesky factorisation eliminates the particles, and their supernodes.
struct Elimination {
  std::vector<int> node_of;           ///< index of the particle at each position
  std::vector<Supernode> supernodes;  ///< children before parents, sorted by `first`
};

/// Plans the elimination for the pattern of `matrix`. The elimination order is `order`, changed so that the particles
/// of a supernode follow each other. The result depends only on the pattern and `order`.
Elimination plan_elimination(const BlockMatrix& matrix, const std::vector<int>& order);

}  // namespace isojam
