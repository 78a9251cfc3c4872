#include "engine/solve/minimise/minimise.hpp"

#include <utility>

#include "engine/solve/minimise/descent.hpp"

namespace isojam {

MinimiseSummary minimise(Packing& packing, PackingEnergy& energy, const MinimiseOptions& options,
                         std::stop_token stop) {
  Descent descent(packing, energy, options, std::move(stop));
  switch (options.method) {
    case Method::conjugate_gradient: return minimise_conjugate_gradient(descent);
    case Method::fire: return minimise_fire(descent);
    case Method::lbfgs: return minimise_lbfgs(descent);
    case Method::newton:
    case Method::multipliers: return minimise_newton(descent);
  }
  return {};
}

}  // namespace isojam
