#include "engine/solve/minimise/summary.hpp"

#include <array>
#include <cstddef>

namespace isojam {

std::string_view to_string(StopReason reason) {
  static constexpr std::array<std::string_view, 9> names{"not_called",         "residual_reached", "energy_change",
                                                         "unjammed",           "precision_floor",  "budget",
                                                         "line_search_failed", "not_finite",       "interrupted"};
  return names[static_cast<std::size_t>(reason)];
}

MinimiseWork& MinimiseWork::operator+=(const MinimiseWork& term) {
  extended_evaluations += term.extended_evaluations;
  hessians += term.hessians;
  factorisations += term.factorisations;
  factor_updates += term.factor_updates;
  return *this;
}

}  // namespace isojam
