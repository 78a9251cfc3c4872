#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <span>

#include "engine/packing/energy.hpp"
#include "engine/solve/minimise/minimise.hpp"

namespace isojam {

// Strain is logarithmic and written in Mandel's components (packing/cell/strain.hpp): moduli under pressure are what it
// costs to shear at constant volume, and K = V d²E/dV².

/// Elastic tensor C_IJ = (1/V) d²E/dε_I dε_J at ε = 0, in Y. Isotropic: 3K − 3p along the trace, 2G on the traceless
/// five.
struct ElasticTensor {
  Matrix6d affine = Matrix6d::Zero();  ///< all centres follow the strain, orientations fixed
  Matrix6d relaxed = Matrix6d::Zero();  ///< the packing relaxes at every strain: affine − Ξᵀ D⁺ Ξ, Ξ = ∂²E/∂r∂ε over V
  double pressure = 0;                  ///< p, Y

  double affine_bulk_modulus() const;          ///< K without relaxation, Y
  double bulk_modulus() const;                 ///< K
  std::array<double, 5> shear_moduli() const;  ///< of the traceless five, ascending; a negative one is unstable
  double mean_shear_modulus() const;           ///< over them (Voigt's average)
};

/// Elastic tensor from the Hessian, the contacts (PackingEnergy::contacts) and the evaluation of one equilibrium.
/// Blocks whose pair has no contact in the list, which may happen to overlaps that only double-double sees, are
/// strained at the nearest image. Particles without contacts take no part. nullopt if D is not positive definite beyond
/// translations and those: then no response is defined.
std::optional<ElasticTensor> elastic_tensor(const Packing& packing, const BlockMatrix& hessian,
                                            std::span<const Contact> contacts, const Evaluation& evaluation);

/// How far the neighbours are, and how well in balance.
struct PressureSlopeOptions {
  /// Strain Δφ/φ of the neighbours. K ∝ (φ − φ_J)⁴ curves, so that it must stay small beside (φ − φ_J)/φ; less is lost
  /// to rounding.
  double strain = 1e-6;
  /// So near by, a few evaluations find an equilibrium; where a hundred times as many do not, beside packings with
  /// particles that are nearly free, neither do twenty times more.
  MinimiseOptions minimise{.residual = 1e-9, .max_evaluations = 1000};
};

/// K from two neighbouring equilibria.
struct PressureSlope {
  double bulk_modulus = 0;       ///< φ dp/dφ by central difference
  MinimiseSummary below, above;  ///< of the two neighbours
};

/// The oracle for K: the pressures of two neighbouring densities, minimised from here. nullopt if one of them finds no
/// equilibrium.
std::optional<PressureSlope> pressure_slope(const Packing& packing, const PressureSlopeOptions& options = {});

}  // namespace isojam
