#pragma once

#include <Eigen/Core>
#include <array>

#include "engine/geometry/overlap/overlap.hpp"
#include "engine/names/enum_names.hpp"

namespace isojam {

/// Strains of the cell that are degrees of freedom, in addition to the positions and orientations of the particles.
/// They are called the free strains.
enum class CellFreedom {
  fixed,      ///< no strain
  isotropic,  ///< only the volume
  shape,      ///< the five strains that preserve the volume; at the minimum the stress is hydrostatic
  free        ///< all six strains; at the minimum the stress is the prescribed stress
};
template <>
inline constexpr std::array enum_names<CellFreedom>{
    EnumName{CellFreedom::fixed, "fixed"}, EnumName{CellFreedom::isotropic, "isotropic"},
    EnumName{CellFreedom::shape, "shape"}, EnumName{CellFreedom::free, "free"}};

/// True if the volume is a degree of freedom.
inline bool frees_volume(CellFreedom cell) { return cell == CellFreedom::isotropic || cell == CellFreedom::free; }

/// Free strains of the cell and load on the cell in the variable-cell method (Smith, Srivastava, Fisher, Alam 2014, PRE
/// 89, 042203). They determine the function that is minimised (enthalpy.hpp):
///   fixed, shape   E
///   isotropic      E + p (V − V₀)
///   free           E + p (V − V₀) − V₀ τ:(F − 1)
struct CellControl {
  CellFreedom cell = CellFreedom::fixed;  ///< the free strains
  /// Prescribed pressure p, in units of Y; used only for `isotropic` and `free`. It is positive, or 0 if there is
  /// cohesion.
  double pressure = 0;
  /// Deviatoric part τ of the prescribed stress −p·1 + τ, symmetric and traceless, in units of Y; used only for `free`.
  Eigen::Matrix3d deviator = Eigen::Matrix3d::Zero();
};

/// Orthonormal basis of the free strains. Each column is a strain in Mandel components (strain.hpp).
using StrainBasis = Eigen::Matrix<double, 6, Eigen::Dynamic, 0, 6, 6>;
/// The basis of the free strains. It has no columns for a fixed cell.
StrainBasis strain_basis(CellFreedom cell);
/// The CellFreedom with this number of free strains: 0, 1, 5 or 6.
CellFreedom freedom_of(Eigen::Index strains);

/// The length ℓ = √N V_p^(1/3). The coordinate of a free strain ε is ℓ·ε: steps contain ℓ·ε, and gradients contain
/// derivatives with respect to ℓ·ε. A strain moves all N particles. With the factor ℓ, the stiffness of a strain
/// coordinate is similar to the stiffness of a coordinate of one particle (Sheppard et al. 2012).
double strain_length(int particles);

}  // namespace isojam
