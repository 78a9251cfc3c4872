#pragma once

#include "engine/packing/block_matrix.hpp"

namespace isojam {

enum class Pinning {
  translations,                ///< the three translations of particle 0
  translations_and_untouched,  ///< and particles without contacts, which have no stiffness at all
};

/// D with some coordinates held: their rows and columns 0, `held_diagonal` on the diagonal. D being blind to
/// translations, the rest is definite exactly where D is definite beyond them, and D u = f, f without resultant, is
/// solved by the u found here, up to a translation.
BlockMatrix pinned_matrix(const BlockMatrix& matrix, double held_diagonal, Pinning pinning);

}  // namespace isojam
