#pragma once

#include "engine/packing/block_matrix.hpp"

namespace isojam {

enum class Pinning {
  translations,                ///< the three translations of particle 0
  translations_and_untouched,  ///< also all coordinates of particles without contacts, which have no stiffness
};

/// D with some coordinates pinned: their rows and columns are 0, with `held_diagonal` on the diagonal. Since D is zero
/// for translations, the rest is definite exactly if D is definite apart from translations. For a force f without
/// resultant the solution u of this matrix solves D u = f, up to a translation.
BlockMatrix pinned_matrix(const BlockMatrix& matrix, double held_diagonal, Pinning pinning);

}  // namespace isojam
