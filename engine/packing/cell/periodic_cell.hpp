#pragma once

#include <Eigen/Core>

#include "engine/geometry/convex_solid.hpp"
#include "engine/geometry/pose.hpp"

namespace isojam {

/// Periodic cell: a parallelepiped that is spanned by three lattice vectors in double-double. Lengths are in units of
/// V_p^(1/3).
class PeriodicCell {
 public:
  /// Makes a cube of side L. Throws std::invalid_argument unless `side` is finite and positive.
  explicit PeriodicCell(double side);
  /// Makes a cell whose lattice vectors are the columns of `vectors`. Throws std::invalid_argument unless the vectors
  /// are finite and right-handed.
  explicit PeriodicCell(const DoubleDoubleMatrix& vectors);

  bool operator==(const PeriodicCell& other) const;

  /// True if the lattice vectors are exactly L x̂, L ŷ, L ẑ.
  bool is_cube() const { return is_cube_; }
  /// The side L of a cube, or V_cell^(1/3) for any other cell.
  double side() const { return side_; }
  double volume() const { return volume_; }                       ///< volume V_cell, in units of V_p
  DoubleDouble volume_double_double() const;                      ///< V_cell with a relative error of at most 1e-31
  const DoubleDoubleMatrix& vectors() const { return vectors_; }  ///< the lattice vectors, as columns
  /// Heights of the cell: the distances between opposite faces, one for each lattice vector. If the coordinates
  /// fractional() of two points differ by n along a lattice vector, their distance is at least n times the height.
  const Eigen::Vector3d& heights() const { return heights_; }
  /// Coordinates of a vector d in the basis of the lattice vectors.
  Eigen::Vector3d fractional(const Eigen::Vector3d& d) const;

  /// The lattice translation Σ_c shift_c·(lattice vector c).
  Eigen::Vector3d translation(const Eigen::Vector3i& shift) const {
    const Eigen::Vector3d s = shift.cast<double>();
    if (is_cube_) return side_ * s;
    return vectors_.high * s;
  }
  /// One component of translation() in double-double.
  DoubleDouble translation_double_double(int component, const Eigen::Vector3i& shift) const;

  /// The integers k for which every entry of fractional(d) + k is in [−½, ½).
  Eigen::Vector3i nearest_shift(const Eigen::Vector3d& d) const;
  /// The shortest vector among all periodic images of d.
  Eigen::Vector3d nearest_image(const Eigen::Vector3d& d) const;
  /// Length of the shortest lattice translation.
  double shortest_translation() const;

  /// The cell whose lattice vectors are F times the lattice vectors of this cell. Throws std::invalid_argument unless
  /// the new vectors are finite and right-handed.
  PeriodicCell deformed(const DoubleDoubleMatrix& f) const;
  /// The cell of the same lattice with the shortest lattice vectors (Minkowski reduction). It is much less skew than a
  /// cell after a large shear. If the lattice vectors are already the shortest ones, the result is the unchanged cell.
  PeriodicCell reduced() const;

 private:
  void measure();

  DoubleDoubleMatrix vectors_;
  Eigen::Matrix3d inverse_;
  Eigen::Vector3d heights_;
  double side_, volume_;
  bool is_cube_;
};

/// Two diameters of the solid. If every lattice translation is longer than this, no particle touches two images of
/// another particle. Proof: the centres of all images of B that touch A lie in the Minkowski sum A ⊕ (−B). The diameter
/// of this sum is at most diameter(A) + diameter(B). Two images of B differ by a lattice translation. If this
/// translation is longer than the diameter of the sum, A touches at most one of the two images. The shortest lattice
/// translation of a cube is its side.
double least_side(const ConvexSolid& solid);

/// True if no particle can touch two images of another particle: shortest_translation() > least_side(solid). `solid` is
/// the solid of the packing with the largest diameter. In comments, such a cell is called legal for the particles.
bool is_legal(const PeriodicCell& cell, const ConvexSolid& solid);

/// Side (n/φ)^(1/3) of a cubic cell with n particles of unit volume at density φ.
double side_at(int n, double density);

/// Smallest number of particles of unit volume for which a cubic cell is legal at density φ. A cell with this number
/// of particles is then also legal at all lower densities.
int least_particles(const ConvexSolid& solid, double density);

}  // namespace isojam
