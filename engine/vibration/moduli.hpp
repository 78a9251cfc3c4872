#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <span>

#include "engine/packing/energy.hpp"
#include "engine/solve/minimise/minimise.hpp"

namespace isojam {

// Strain is logarithmic and in Mandel's components (packing/cell/strain.hpp). Moduli under pressure are therefore those
// of shear at constant volume, and K = V d²E/dV².

/// Elastic tensor C_IJ = (1/V) d²E/dε_I dε_J at ε = 0, in Y. For an isotropic packing: 3K − 3p along the trace, 2G on
/// the five traceless strains.
struct ElasticTensor {
  Matrix6d affine = Matrix6d::Zero();  ///< all centres follow the strain, orientations fixed
  Matrix6d relaxed = Matrix6d::Zero();  ///< the packing relaxes at every strain: affine − Ξᵀ D⁺ Ξ, Ξ = ∂²E/∂r∂ε over V
  double pressure = 0;                  ///< p, Y

  double affine_bulk_modulus() const;          ///< K without relaxation, Y
  double bulk_modulus() const;                 ///< K
  std::array<double, 5> shear_moduli() const;  ///< for the five traceless strains, ascending; negative if unstable
  double mean_shear_modulus() const;           ///< their mean (Voigt average)
};

/// Elastic tensor from the Hessian, the contacts (PackingEnergy::contacts) and the evaluation of one equilibrium. A
/// block whose pair is missing in the list of contacts is strained at the nearest image; this may happen for overlaps
/// that only double-double resolves. Particles without contacts are ignored. nullopt if D is not positive definite,
/// apart from translations and such particles: the response is then undefined.
std::optional<ElasticTensor> elastic_tensor(const Packing& packing, const BlockMatrix& hessian,
                                            std::span<const Contact> contacts, const Evaluation& evaluation);

/// Distance of the neighbouring states, and their minimisation.
struct PressureSlopeOptions {
  /// Strain Δφ/φ of the neighbours. It must be small compared with (φ − φ_J)/φ because K ∝ (φ − φ_J)⁴ is curved; the
  /// rounding error is smaller than that.
  double strain = 1e-6;
  /// A few evaluations are enough for such a near equilibrium. If a hundred times as many are not, as in packings with
  /// almost free particles, twenty times more are not enough either.
  MinimiseOptions minimise{.residual = 1e-9, .max_evaluations = 1000};
};

/// K from two neighbouring equilibria.
struct PressureSlope {
  double bulk_modulus = 0;       ///< φ dp/dφ by central difference
  MinimiseSummary below, above;  ///< summaries of the two neighbours
};

/// Test oracle for K: pressures at two neighbouring densities, minimised from this state. nullopt if a minimisation
/// finds no equilibrium.
std::optional<PressureSlope> pressure_slope(const Packing& packing, const PressureSlopeOptions& options = {});

}  // namespace isojam
