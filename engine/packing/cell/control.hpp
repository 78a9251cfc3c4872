#pragma once

#include <Eigen/Core>
#include <array>

#include "engine/geometry/overlap/overlap.hpp"
#include "engine/names/enum_names.hpp"

namespace isojam {

/// Strains of the cell that are degrees of freedom, in addition to positions and orientations.
enum class CellFreedom {
  fixed,      ///< no strain
  isotropic,  ///< the volume, at a prescribed pressure
  shape,      ///< the five strains that preserve the volume: the minimum has hydrostatic stress
  free        ///< all six strains: the stress at the minimum is the prescribed one
};
template <>
inline constexpr std::array enum_names<CellFreedom>{
    EnumName{CellFreedom::fixed, "fixed"}, EnumName{CellFreedom::isotropic, "isotropic"},
    EnumName{CellFreedom::shape, "shape"}, EnumName{CellFreedom::free, "free"}};

/// True if the volume is a degree of freedom.
inline bool frees_volume(CellFreedom cell) { return cell == CellFreedom::isotropic || cell == CellFreedom::free; }

/// Freedom and load of the cell while a packing is minimised: the variable-cell method (Smith, Srivastava, Fisher, Alam
/// 2014, PRE 89, 042203). Energy becomes enthalpy, E + p V_cell.
struct CellControl {
  CellFreedom cell = CellFreedom::fixed;  ///< strains that are free
  double pressure = 0;                    ///< p > 0 (Y), if the volume is free
  /// τ, symmetric and traceless. If all strains are free, the prescribed stress is −p·1 + τ.
  Eigen::Matrix3d deviator = Eigen::Matrix3d::Zero();
};

/// Orthonormal basis of the strains that are degrees of freedom: columns in Mandel's components (strain.hpp).
using StrainBasis = Eigen::Matrix<double, 6, Eigen::Dynamic, 0, 6, 6>;
/// Basis of the free strains; no columns for a fixed cell.
StrainBasis strain_basis(CellFreedom cell);
/// The CellFreedom with this number of strains: 0, 1, 5 or 6.
CellFreedom freedom_of(Eigen::Index strains);

/// Steps and gradients contain strains as ℓ·ε with ℓ = √N V_p^(1/3), which makes them similar to the coordinates of
/// particles (Sheppard et al. 2012): an affine strain moves N particles, and its stiffness is then that of a single
/// particle.
double strain_length(int particles);

}  // namespace isojam
