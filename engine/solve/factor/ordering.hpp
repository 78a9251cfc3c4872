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

/// One of these two orders, selected by the number of particles: the order with which an ordering and a factorisation
/// together take less time.
std::vector<int> fill_reducing_order(const BlockMatrix& matrix);

}  // namespace isojam
