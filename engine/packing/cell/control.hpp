#pragma once

#include <Eigen/Core>
#include <array>

#include "engine/geometry/overlap/overlap.hpp"
#include "engine/names/enum_names.hpp"

namespace isojam {

/// Strains of the cell that are degrees of freedom in addition to positions and orientations. They are called the free
/// strains.
enum class CellFreedom {
  fixed,      ///< no strain
  isotropic,  ///< only the volume, at a prescribed pressure
  shape,      ///< the five strains that preserve the volume; at the minimum the stress is hydrostatic
  free        ///< all six strains; at the minimum the stress is equal to the prescribed stress
};
template <>
inline constexpr std::array enum_names<CellFreedom>{
    EnumName{CellFreedom::fixed, "fixed"}, EnumName{CellFreedom::isotropic, "isotropic"},
    EnumName{CellFreedom::shape, "shape"}, EnumName{CellFreedom::free, "free"}};

/// True if the volume is a degree of freedom.
inline bool frees_volume(CellFreedom cell) { return cell == CellFreedom::isotropic || cell == CellFreedom::free; }

/// Free strains of the cell and load on the cell while a packing is minimised: the variable-cell method (Smith,
/// Srivastava, Fisher, Alam 2014, PRE 89, 042203). If strains are free, the enthalpy E + p V_cell is minimised instead
/// of the energy.
struct CellControl {
  CellFreedom cell = CellFreedom::fixed;  ///< the free strains
  double pressure = 0;                    ///< prescribed pressure p > 0 (Y); used only if the volume is free
  /// Deviator τ of the prescribed stress, symmetric and traceless (Y). If all strains are free, the prescribed stress
  /// is −p·1 + τ.
  Eigen::Matrix3d deviator = Eigen::Matrix3d::Zero();
};

/// Orthonormal basis of the free strains. Each column is a strain in Mandel's components (strain.hpp).
using StrainBasis = Eigen::Matrix<double, 6, Eigen::Dynamic, 0, 6, 6>;
/// The basis of the free strains. It has no columns for a fixed cell.
StrainBasis strain_basis(CellFreedom cell);
/// The CellFreedom that has this number of free strains: 0, 1, 5 or 6.
CellFreedom freedom_of(Eigen::Index strains);

/// The length ℓ = √N V_p^(1/3). Steps and gradients contain a strain ε as the coordinate ℓ·ε. An affine strain moves
/// all N particles; with the factor ℓ, its stiffness is similar to that of a coordinate of a single particle (Sheppard
/// et al. 2012).
double strain_length(int particles);

}  // namespace isojam
