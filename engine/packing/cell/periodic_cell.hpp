#pragma once

#include <Eigen/Core>

#include "engine/geometry/convex_solid.hpp"
#include "engine/geometry/pose.hpp"

namespace isojam {

/// Periodic cell, spanned by three lattice vectors, each a double-double: a cube of side L unless it was made
/// otherwise. Lengths in V_p^(1/3).
class PeriodicCell {
 public:
  /// A cube. Throws std::invalid_argument unless side is finite and positive.
  explicit PeriodicCell(double side);
  /// Lattice vectors as columns. Throws std::invalid_argument unless they are finite and right-handed.
  explicit PeriodicCell(const DoubleDoubleMatrix& vectors);

  bool operator==(const PeriodicCell& other) const;

  /// Whether the lattice vectors are L x̂, L ŷ, L ẑ to the last bit.
  bool is_cube() const { return is_cube_; }
  /// L of a cube; of other cells V_cell^(1/3).
  double side() const { return side_; }
  double volume() const { return volume_; }                       ///< V_cell, V_p
  DoubleDouble volume_double_double() const;                      ///< the same to 1e-31
  const DoubleDoubleMatrix& vectors() const { return vectors_; }  ///< the lattice vectors, as columns
  /// Distances between opposite faces of the cell: what lies n cells apart along a lattice vector is no nearer than n
  /// of these.
  const Eigen::Vector3d& heights() const { return heights_; }
  /// Coordinates of d along the lattice vectors, in cells.
  Eigen::Vector3d fractional(const Eigen::Vector3d& d) const;

  /// Σ_c shift_c·(lattice vector c).
  Eigen::Vector3d translation(const Eigen::Vector3i& shift) const {
    const Eigen::Vector3d s = shift.cast<double>();
    if (is_cube_) return side_ * s;
    return vectors_.high * s;
  }
  /// One component of translation().
  DoubleDouble translation_double_double(int component, const Eigen::Vector3i& shift) const;

  /// Integers k with fractional(d) + k in [−½, ½) along each lattice vector.
  Eigen::Vector3i nearest_shift(const Eigen::Vector3d& d) const;
  /// The shortest of all images of d.
  Eigen::Vector3d nearest_image(const Eigen::Vector3d& d) const;
  /// Length of the shortest translation that the lattice has.
  double shortest_translation() const;

  /// The cell with lattice vectors F·(lattice vectors). Throws std::invalid_argument as the constructor does.
  PeriodicCell deformed(const DoubleDoubleMatrix& f) const;
  /// A cell of the same lattice whose vectors are the shortest that span it (Minkowski's reduction): heights and angles
  /// are then as large as the lattice has them. A cell that is so already is returned as it is.
  PeriodicCell reduced() const;

 private:
  void measure();

  DoubleDoubleMatrix vectors_;
  Eigen::Matrix3d inverse_;
  Eigen::Vector3d heights_;
  double side_, volume_;
  bool is_cube_;
};

/// Length of lattice translations below which a particle may touch two images of another: images of B that touch A lie
/// in A ⊕ (−B), whose diameter is at most diameter(A) + diameter(B), and two of them differ by a translation; so the
/// shortest translation must exceed 2·diameter, in a cube its side, in any cell.
double least_side(const ConvexSolid& solid);

/// Whether no particle can touch two images of another: shortest_translation() > least_side(solid).
bool is_legal(const PeriodicCell& cell, const ConvexSolid& solid);

/// Side of the cubic cell of n unit-volume particles at density φ: (n/φ)^(1/3).
double side_at(int n, double density);

/// Least number of particles whose cubic cell is legal up to density φ.
int least_particles(const ConvexSolid& solid, double density);

}  // namespace isojam
