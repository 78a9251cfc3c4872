#pragma once

#include <Eigen/Core>

#include "engine/geometry/convex_solid.hpp"

namespace isojam {

/// Periodic cube of side L.
class PeriodicCell {
 public:
  /// Throws std::invalid_argument unless side is finite and positive.
  explicit PeriodicCell(double side);

  double side() const { return side_; }
  double volume() const { return side_ * side_ * side_; }
  /// Integers k with d + L·k in [−L/2, L/2) along each axis.
  Eigen::Vector3i nearest_shift(const Eigen::Vector3d& d) const;
  Eigen::Vector3d nearest_image(const Eigen::Vector3d& d) const;

 private:
  double side_;
};

/// Least side at which no particle can touch two images of another: images of B that touch A lie in A ⊕ (−B),
/// whose diameter is at most diameter(A) + diameter(B); so L must exceed 2·diameter.
double least_side(const ConvexSolid& solid);

/// Side of the cell of n unit-volume particles at density φ: (n/φ)^(1/3).
double side_at(int n, double density);

/// Least number of particles whose cell is legal up to density φ.
int least_particles(const ConvexSolid& solid, double density);

}  // namespace isojam
