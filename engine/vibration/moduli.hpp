#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <span>

#include "engine/packing/energy.hpp"
#include "engine/solve/minimise/minimise.hpp"

namespace isojam {

// Strains are logarithmic strains in Mandel components (packing/cell/strain.hpp). At finite pressure, shear moduli are
// therefore defined at constant volume, and the bulk modulus is K = V d²E/dV², where V is the volume of the cell.

/// Elastic tensor C_IJ = (1/V) d²E/dε_I dε_J at ε = 0, in units of Y. For an isotropic packing, it has the eigenvalue
/// 3K − 3p for the isotropic strain, and the eigenvalue 2G for the five traceless strains.
struct ElasticTensor {
  /// tensor without relaxation: all centres follow the strain, and orientations do not change
  Matrix6d affine = Matrix6d::Zero();
  /// tensor with relaxation of all particles: `affine` − Ξᵀ H⁺ Ξ/V, with Ξ = ∂²E/∂r∂ε and the pseudo-inverse H⁺ of the
  /// Hessian
  Matrix6d relaxed = Matrix6d::Zero();
  double pressure = 0;  ///< pressure p, in units of Y

  double affine_bulk_modulus() const;  ///< bulk modulus K without relaxation, in units of Y
  double bulk_modulus() const;         ///< bulk modulus K with relaxation, in units of Y
  /// shear moduli of the five traceless strains, ascending, in units of Y; a negative modulus means that the packing
  /// is unstable
  std::array<double, 5> shear_moduli() const;
  double mean_shear_modulus() const;  ///< mean of the five shear moduli (Voigt average), in units of Y
};

/// Computes the elastic tensor of an equilibrium from its Hessian, its contacts (PackingEnergy::contacts()) and its
/// evaluation. If a block of the Hessian belongs to a pair that is not in `contacts`, the pair is assumed to touch at
/// the nearest image. This can happen for overlaps that only double-double resolves. Particles without contacts are
/// ignored. nullopt if any motion of the other particles, apart from translations, has no positive stiffness. The
/// response is undefined in this case.
std::optional<ElasticTensor> elastic_tensor(const Packing& packing, const BlockMatrix& hessian,
                                            std::span<const Contact> contacts, const Evaluation& evaluation);

/// Options of pressure_slope().
struct PressureSlopeOptions {
  /// Relative difference between the densities of the neighbouring states and the density φ of this state. It must be
  /// small compared with (φ − φ_J)/φ, because K ∝ (φ − φ_J)⁴ is not linear in φ. The error due to rounding is smaller
  /// than the error due to this curvature.
  double strain = 1e-6;
  /// Options of the minimisations. The start is so close to the equilibrium that a few evaluations are usually enough.
  /// If 1000 are not enough, as in packings with nearly unconstrained particles, 20 000 are not enough either.
  MinimiseOptions minimise{.residual = 1e-9, .max_evaluations = 1000};
};

/// Bulk modulus from two neighbouring equilibria.
struct PressureSlope {
  double bulk_modulus = 0;       ///< φ dp/dφ by central difference
  MinimiseSummary below, above;  ///< summaries of the two minimisations
};

/// Computes the bulk modulus from the pressures of equilibria at two neighbouring densities. Both are minimised from
/// the given state. The result is a check of elastic_tensor(). nullopt if a minimisation finds no equilibrium.
std::optional<PressureSlope> pressure_slope(const Packing& packing, const PressureSlopeOptions& options = {});

}  // namespace isojam
