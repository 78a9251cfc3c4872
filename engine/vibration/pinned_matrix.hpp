#pragma once

#include "engine/packing/block_matrix.hpp"

namespace isojam {

enum class Pinning {
  translations,                ///< the three translations of particle 0
  translations_and_untouched,  ///< also all coordinates of particles without contacts, which have no stiffness
};

/// D with some coordinates pinned: their rows and columns are 0, except for `pinned_diagonal` on the diagonal.
/// Translations are null vectors of D. The matrix is therefore positive definite if and only if D is positive definite
/// apart from translations. If the sum of the forces f on all particles is 0, the solution u with this matrix also
/// solves D u = f, up to a translation.
BlockMatrix pinned_matrix(const BlockMatrix& matrix, double pinned_diagonal, Pinning pinning);

}  // namespace isojam
