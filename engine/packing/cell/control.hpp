#pragma once

#include <Eigen/Core>
#include <array>

#include "engine/geometry/overlap/overlap.hpp"
#include "engine/names/enum_names.hpp"

namespace isojam {

/// Which strains of the cell are degrees of freedom, beside positions and orientations.
enum class CellFreedom {
  fixed,      ///< none
  isotropic,  ///< its volume: against a pressure
  shape,      ///< all five that leave its volume alone: until the stress is hydrostatic
  free        ///< all six: until the stress is the pressure, and nothing else
};
template <>
inline constexpr std::array enum_names<CellFreedom>{
    EnumName{CellFreedom::fixed, "fixed"}, EnumName{CellFreedom::isotropic, "isotropic"},
    EnumName{CellFreedom::shape, "shape"}, EnumName{CellFreedom::free, "free"}};

/// Whether the volume is a degree of freedom.
inline bool frees_volume(CellFreedom cell) { return cell == CellFreedom::isotropic || cell == CellFreedom::free; }

/// What is done to the cell while a packing is minimised: the variable-cell method (Smith, Srivastava, Fisher, Alam
/// 2014, PRE 89, 042203). Energy becomes enthalpy, E + p V_cell.
struct CellControl {
  CellFreedom cell = CellFreedom::fixed;  ///< which strains are free
  double pressure = 0;                    ///< p > 0 (Y), where the volume is free
  /// τ, symmetric and traceless: the stress asked for is −p·1 + τ, where all strains are free.
  Eigen::Matrix3d deviator = Eigen::Matrix3d::Zero();
};

/// Orthonormal basis, as columns in Mandel's components (strain.hpp), of the strains that are degrees of freedom.
using StrainBasis = Eigen::Matrix<double, 6, Eigen::Dynamic, 0, 6, 6>;
/// Of the strains that are free; no columns where the cell is fixed.
StrainBasis strain_basis(CellFreedom cell);
/// The one with so many: 0, 1, 5 or 6.
CellFreedom freedom_of(Eigen::Index strains);

/// Strains stand in steps and gradients as ℓ·ε with ℓ = √N V_p^(1/3), which makes them coordinates like those of
/// particles (Sheppard et al. 2012): an affine strain moves N particles, and is as stiff against them as they are one
/// by one.
double strain_length(int particles);

}  // namespace isojam
