#pragma once

#include <optional>
#include <vector>

#include "engine/packing/block_matrix.hpp"
#include "engine/packing/cell/control.hpp"
#include "engine/packing/cohesion.hpp"
#include "engine/packing/contact_terms.hpp"
#include "engine/packing/overlap_cache.hpp"

namespace isojam {

/// Computes the terms −w V_h of the energy. An object contains only caches. V_h and its derivatives come from the same
/// functions as V, for a packing of grown solids.
class CohesionEnergy {
 public:
  /// The terms for this range and strength.
  explicit CohesionEnergy(const Cohesion& cohesion) : cohesion_(cohesion) {}

  /// The solids of the particles with all faces moved outwards by h/2.
  const Composition& grown_solids(const Packing& packing);
  /// Computes the contributions of all pairs with V_h > 0. The numbers of pairs are added to `counts`. Throws
  /// std::invalid_argument if a solid cannot grow, see can_grow(), or if the cell is not legal for the grown solids
  /// (is_legal() in cell/periodic_cell.hpp).
  const PairTerms& evaluate(const Packing& packing, Precision precision, PairCounts& counts);
  /// Computes the second derivatives of the terms, as SecondOrder::hessian.
  BlockMatrix hessian(const Packing& packing, Precision precision, CellFreedom cell, PairCounts& counts);

 private:
  void update(const Packing& packing, Precision precision, PairCounts& counts);

  Cohesion cohesion_;
  OverlapCache overlaps_;
  PairTerms terms_;
  std::optional<Packing> grown_;
  std::optional<Composition> grown_from_;  ///< the solids from which those of grown_ were made
};

}  // namespace isojam
