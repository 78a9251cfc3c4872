#include "engine/packing/periodic_cell.hpp"

#include <cmath>
#include <stdexcept>

namespace isojam {

PeriodicCell::PeriodicCell(double side) : side_(side) {
  if (!(std::isfinite(side) && side > 0)) throw std::invalid_argument("the side of a cell is a positive number");
}

Eigen::Vector3i PeriodicCell::nearest_shift(const Eigen::Vector3d& d) const {
  Eigen::Vector3i shift;
  for (int c = 0; c < 3; ++c) shift[c] = -static_cast<int>(std::floor(d[c] / side_ + 0.5));
  return shift;
}

Eigen::Vector3d PeriodicCell::nearest_image(const Eigen::Vector3d& d) const {
  return d + side_ * nearest_shift(d).cast<double>();
}

double least_side(const ConvexSolid& solid) { return 2 * solid.diameter(); }

double side_at(int n, double density) { return std::cbrt(n / density); }

int least_particles(const ConvexSolid& solid, double density) {
  int n = static_cast<int>(density * std::pow(least_side(solid), 3));
  while (side_at(n, density) <= least_side(solid)) ++n;
  return n;
}

}  // namespace isojam
