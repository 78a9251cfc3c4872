#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <span>

#include "engine/packing/energy.hpp"
#include "engine/solve/minimise/minimise.hpp"

namespace isojam {

// Strains are logarithmic strains in Mandel's components (packing/cell/strain.hpp). At finite pressure, shear moduli
// are therefore defined at constant volume, and the bulk modulus is K = V d²E/dV².

/// Elastic tensor C_IJ = (1/V) d²E/dε_I dε_J at ε = 0, in units of Y. For an isotropic packing, its eigenvalues are 3K
/// − 3p for the isotropic strain, and 2G for the five traceless strains.
struct ElasticTensor {
  /// tensor without relaxation: all centres follow the strain, and orientations are fixed
  Matrix6d affine = Matrix6d::Zero();
  /// tensor with relaxation of all particles: affine − Ξᵀ D⁺ Ξ, where Ξ = ∂²E/∂r∂ε; both terms are divided by V
  Matrix6d relaxed = Matrix6d::Zero();
  double pressure = 0;  ///< pressure p, in units of Y

  double affine_bulk_modulus() const;  ///< bulk modulus K without relaxation, in units of Y
  double bulk_modulus() const;         ///< K
  /// shear moduli of the five traceless strains, ascending; a negative value means that the packing is unstable
  std::array<double, 5> shear_moduli() const;
  double mean_shear_modulus() const;  ///< mean of the shear moduli (Voigt average)
};

/// Computes the elastic tensor of an equilibrium from its Hessian, its contacts (PackingEnergy::contacts) and its
/// evaluation. If the pair of a block of the Hessian is not in `contacts`, the nearest image is used for the strain;
/// this can happen for overlaps that only double-double resolves. Particles without contacts are ignored. nullopt if D
/// is not positive definite apart from translations and particles without contacts, because the response is then
/// undefined.
std::optional<ElasticTensor> elastic_tensor(const Packing& packing, const BlockMatrix& hessian,
                                            std::span<const Contact> contacts, const Evaluation& evaluation);

/// Distance of the two neighbouring states, and options of their minimisation.
struct PressureSlopeOptions {
  /// Strain Δφ/φ of the two neighbouring states. It must be small compared with (φ − φ_J)/φ, because K ∝ (φ − φ_J)⁴ is
  /// not linear. The error due to rounding is smaller than the error due to this curvature.
  double strain = 1e-6;
  /// Options of the minimisations. The start is so close to the equilibrium that a few evaluations are usually enough.
  /// If a hundred times as many evaluations are not enough, as in packings with nearly unconstrained particles, twenty
  /// times more are not enough either.
  MinimiseOptions minimise{.residual = 1e-9, .max_evaluations = 1000};
};

/// Bulk modulus from two neighbouring equilibria.
struct PressureSlope {
  double bulk_modulus = 0;       ///< φ dp/dφ by central difference
  MinimiseSummary below, above;  ///< summaries of the two minimisations
};

/// Computes the bulk modulus from the pressures of equilibria at two neighbouring densities, which are minimised from
/// this state. It is a check of elastic_tensor(). nullopt if a minimisation finds no equilibrium.
std::optional<PressureSlope> pressure_slope(const Packing& packing, const PressureSlopeOptions& options = {});

}  // namespace isojam
