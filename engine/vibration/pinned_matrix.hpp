#pragma once

#include "engine/packing/block_matrix.hpp"

namespace isojam {

enum class Pinning {
  translations,                ///< the three translations of particle 0
  translations_and_untouched,  ///< also all coordinates of particles without contacts, which have no stiffness
};

/// A matrix D (dynamical matrix or Hessian) with some coordinates pinned: their rows and columns are 0, except for
/// `pinned_diagonal` > 0 on the diagonal.
/// Pinning particle 0 excludes the translations, which are null vectors of D. With Pinning::translations, the matrix is
/// therefore positive definite if and only if D is positive definite for all other motions. Let D be the
/// Hessian, and f forces on the particles that sum to 0. If the pinned entries of f are set to 0, the solution u with
/// this matrix solves D u = f for the original f.
BlockMatrix pinned_matrix(const BlockMatrix& matrix, double pinned_diagonal, Pinning pinning);

}  // namespace isojam
