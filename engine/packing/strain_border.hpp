#pragma once

#include <Eigen/Core>

#include "engine/packing/block_matrix.hpp"
#include "engine/packing/cell/control.hpp"
#include "engine/packing/pair_energy.hpp"

namespace isojam {

/// Borders second derivatives with those with respect to the free strains. The energy of a pair depends on its centres
/// through r = x_b − x_a, and strain changes r to exp(ε) r = r + ε r + ½ ε² r + …. With the coordinates ℓ·ε
/// (control.hpp),
///   ∂²E/∂q∂ε = Σ (∂²e/∂q∂r) ∂r/∂ε,   ∂²E/∂ε² = Σ ∂r/∂ε·(∂²e/∂r²) ∂r/∂ε + ½ (∂e/∂r)·∂²(ε² r)/∂ε².
/// Without free strains it does nothing.
class StrainBorder {
 public:
  /// Sets border and corner of `matrix` to zero; the matrix must outlive this object.
  StrainBorder(CellFreedom cell, int particles, BlockMatrix& matrix);

  /// Adds a pair with second derivatives `h`, slope ∂e/∂r and displacement r; lab frame.
  void add_pair(int a, int b, const PairHessian& h, const Eigen::Vector3d& slope, const Eigen::Vector3d& r);
  /// Derivatives with respect to the free strains for a virial Σ (∂e/∂r) rᵀ.
  Eigen::VectorXd slopes(const Eigen::Matrix3d& virial) const;
  /// Adds the terms of second order in ε. Call it after the last pair.
  void finish();

 private:
  StrainBasis basis_;  ///< divided by ℓ
  BlockMatrix& matrix_;
  Eigen::Matrix3d virial_ = Eigen::Matrix3d::Zero();  ///< Σ (∂e/∂r) rᵀ = V_cell·stress
};

/// Matrix of the quadratic form T:ε² of ε in Mandel's components, T symmetric.
Matrix6d of_squared_strain(const Eigen::Matrix3d& tensor);

}  // namespace isojam
