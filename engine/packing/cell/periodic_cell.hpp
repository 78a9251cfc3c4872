#pragma once

#include <Eigen/Core>

#include "engine/geometry/convex_solid.hpp"
#include "engine/geometry/pose.hpp"

namespace isojam {

/// Periodic cell, spanned by three lattice vectors, each in double-double. It is a cube of side L unless constructed or
/// deformed otherwise. Lengths in V_p^(1/3).
class PeriodicCell {
 public:
  /// A cube. Throws std::invalid_argument unless side is finite and positive.
  explicit PeriodicCell(double side);
  /// A cell with these lattice vectors as columns. Throws std::invalid_argument unless they are finite and
  /// right-handed.
  explicit PeriodicCell(const DoubleDoubleMatrix& vectors);

  bool operator==(const PeriodicCell& other) const;

  /// True if the lattice vectors are exactly L x̂, L ŷ, L ẑ.
  bool is_cube() const { return is_cube_; }
  /// L for a cube; V_cell^(1/3) for other cells.
  double side() const { return side_; }
  double volume() const { return volume_; }                       ///< V_cell, V_p
  DoubleDouble volume_double_double() const;                      ///< V_cell with an error of at most 1e-31
  const DoubleDoubleMatrix& vectors() const { return vectors_; }  ///< the lattice vectors, as columns
  /// Distances between opposite faces of the cell. Points that are n cells apart along a lattice vector have at least n
  /// times this distance.
  const Eigen::Vector3d& heights() const { return heights_; }
  /// Coordinates of d in units of the lattice vectors.
  Eigen::Vector3d fractional(const Eigen::Vector3d& d) const;

  /// Σ_c shift_c·(lattice vector c).
  Eigen::Vector3d translation(const Eigen::Vector3i& shift) const {
    const Eigen::Vector3d s = shift.cast<double>();
    if (is_cube_) return side_ * s;
    return vectors_.high * s;
  }
  /// One component of translation() in double-double.
  DoubleDouble translation_double_double(int component, const Eigen::Vector3i& shift) const;

  /// Integers k such that fractional(d) + k is in [−½, ½) along each lattice vector.
  Eigen::Vector3i nearest_shift(const Eigen::Vector3d& d) const;
  /// The shortest of all periodic images of d.
  Eigen::Vector3d nearest_image(const Eigen::Vector3d& d) const;
  /// Length of the shortest lattice translation.
  double shortest_translation() const;

  /// The cell with lattice vectors F·(lattice vectors). Throws std::invalid_argument like the constructor.
  PeriodicCell deformed(const DoubleDoubleMatrix& f) const;
  /// A cell of the same lattice with the shortest spanning vectors (Minkowski reduction), which have the largest
  /// heights and angles. A cell that is already reduced is returned unchanged.
  PeriodicCell reduced() const;

 private:
  void measure();

  DoubleDoubleMatrix vectors_;
  Eigen::Matrix3d inverse_;
  Eigen::Vector3d heights_;
  double side_, volume_;
  bool is_cube_;
};

/// Length that every lattice translation must exceed so that no particle touches two images of another one. Images of B
/// that touch A lie in A ⊕ (−B), whose diameter is at most diameter(A) + diameter(B), and two of them differ by a
/// lattice translation. So the shortest translation, which is the side of a cube, must exceed 2·diameter.
double least_side(const ConvexSolid& solid);

/// True if no particle can touch two images of another one: shortest_translation() > least_side(solid).
bool is_legal(const PeriodicCell& cell, const ConvexSolid& solid);

/// Side of the cubic cell of n particles of unit volume at density φ: (n/φ)^(1/3).
double side_at(int n, double density);

/// Smallest number of particles whose cubic cell is legal up to density φ.
int least_particles(const ConvexSolid& solid, double density);

}  // namespace isojam
