#pragma once

#include <vector>

#include "engine/packing/block_matrix.hpp"

namespace isojam {

// Elimination orders of the particles that cause little fill-in in a Cholesky factorisation. An order is a list of the
// indices of all particles. It depends only on the pattern of the matrix.

/// The order by approximate minimum degree (Amestoy, Davis & Duff 1996).
std::vector<int> minimum_degree_order(const BlockMatrix& matrix);

/// The order by nested dissection (METIS, Karypis & Kumar 1998). Throws std::bad_alloc if METIS runs out of memory.
std::vector<int> dissection_order(const BlockMatrix& matrix);

/// The minimum-degree order for few particles, and the dissection order for many. The limit is chosen so that the
/// computation of the order and the factorisation together take less time.
std::vector<int> fill_reducing_order(const BlockMatrix& matrix);

}  // namespace isojam
