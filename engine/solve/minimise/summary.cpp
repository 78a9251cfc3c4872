#include "engine/solve/minimise/summary.hpp"

namespace isojam {

MinimiseWork& MinimiseWork::operator+=(const MinimiseWork& term) {
  double_double_evaluations += term.double_double_evaluations;
  hessians += term.hessians;
  factorisations += term.factorisations;
  factor_updates += term.factor_updates;
  envelopes += term.envelopes;
  envelope_overlaps += term.envelope_overlaps;
  local_factorisations += term.local_factorisations;
  incomplete_factorisations += term.incomplete_factorisations;
  krylov_vectors += term.krylov_vectors;
  return *this;
}

}  // namespace isojam
