#pragma once

#include <vector>

#include "engine/packing/block_matrix.hpp"

namespace isojam {

// Orders of the graph of particles with little fill-in in a Cholesky factorisation: the particle at each position. They
// depend only on the pattern of the matrix.

/// Approximate minimum degree (Amestoy, Davis & Duff 1996).
std::vector<int> minimum_degree_order(const BlockMatrix& matrix);

/// Nested dissection (METIS, Karypis & Kumar 1998). Throws std::bad_alloc.
std::vector<int> dissection_order(const BlockMatrix& matrix);

/// The better of these two orders for the number of particles.
std::vector<int> fill_reducing_order(const BlockMatrix& matrix);

}  // namespace isojam
