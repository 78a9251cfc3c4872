#include "engine/solve/minimise/summary.hpp"

#include <array>
#include <cstddef>

namespace isojam {

MinimiseWork& MinimiseWork::operator+=(const MinimiseWork& term) {
  double_double_evaluations += term.double_double_evaluations;
  hessians += term.hessians;
  factorisations += term.factorisations;
  factor_updates += term.factor_updates;
  return *this;
}

}  // namespace isojam
