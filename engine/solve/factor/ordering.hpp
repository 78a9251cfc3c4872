#pragma once

#include <vector>

#include "engine/packing/block_matrix.hpp"

namespace isojam {

// Orders of the graph of particles in which a Cholesky factorisation fills in little: the particle at each place.
// Functions of the pattern of the matrix alone.

/// Approximate minimum degree (Amestoy, Davis & Duff 1996).
std::vector<int> minimum_degree_order(const BlockMatrix& matrix);

/// Nested dissection (METIS, Karypis & Kumar 1998). Throws std::bad_alloc.
std::vector<int> dissection_order(const BlockMatrix& matrix);

/// That of the two which is the better for so many particles.
std::vector<int> fill_reducing_order(const BlockMatrix& matrix);

}  // namespace isojam
