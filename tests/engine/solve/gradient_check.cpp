#include "tests/engine/solve/gradient_check.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace isojam {

GradientCheck check_gradient(const EnergyFunction& function, const Packing& packing, double step,
                             RandomStream& random) {
  const EnergyAndGradient here = function(packing);
  const Eigen::Index size = here.gradient.size();
  GradientCheck check;
  const auto along = [&](const Eigen::VectorXd& direction, Eigen::Index entry) {
    const EnergyAndGradient ahead = function(moved(packing, step * direction));
    const EnergyAndGradient behind = function(moved(packing, -step * direction));
    const double quotient = (ahead.energy - behind.energy) / (2 * step);
    const double slope = here.gradient.dot(direction);
    const double variation =
        std::max(std::abs(ahead.gradient.dot(direction) - slope), std::abs(behind.gradient.dot(direction) - slope));
    // Rounding errors of the energies, and of positions of order L, which the forces turn into errors of the energy.
    const double ulp = std::numeric_limits<double>::epsilon();
    const double rounding = ulp * (8 * std::abs(here.energy) + packing.cell.side() * here.gradient.lpNorm<1>()) / step;
    const double allowed = variation + rounding;
    const double ratio = std::abs(quotient - slope) / allowed;
    if (!(ratio <= check.worst)) check = {ratio, entry, allowed / here.gradient.lpNorm<Eigen::Infinity>()};
  };
  for (Eigen::Index k = 0; k < size && check.passes(); ++k) {
    along(Eigen::VectorXd::Unit(size, k), k);
    Eigen::VectorXd direction(size);
    for (double& entry : direction) entry = random.normal();
    along(direction / direction.norm(), -1);
  }
  return check;
}

}  // namespace isojam
