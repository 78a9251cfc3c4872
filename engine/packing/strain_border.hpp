#pragma once

#include <Eigen/Core>

#include "engine/packing/block_matrix.hpp"
#include "engine/packing/cell/control.hpp"
#include "engine/packing/pair_energy.hpp"

namespace isojam {

/// Computes the border and the corner of a Hessian: the second derivatives with respect to the free strains. The energy
/// of a pair depends on its centres only through r = x_b − x_a, and a strain changes r to exp(ε) r = r + ε r + ½ ε² r +
/// …. With the coordinates ℓ·ε (control.hpp),
///   ∂²E/∂q∂ε = Σ (∂²e/∂q∂r) ∂r/∂ε,   ∂²E/∂ε² = Σ ∂r/∂ε·(∂²e/∂r²) ∂r/∂ε + ½ (∂e/∂r)·∂²(ε² r)/∂ε².
/// If there are no free strains, this class does nothing.
class StrainBorder {
 public:
  /// Sets border and corner of `matrix` to zero; the matrix must outlive this object.
  StrainBorder(CellFreedom cell, int particles, BlockMatrix& matrix);

  /// Adds a pair with the second derivatives `h`, the slope ∂e/∂r and the displacement r, all in the lab frame.
  void add_pair(int a, int b, const PairHessian& h, const Eigen::Vector3d& slope, const Eigen::Vector3d& r);
  /// First derivatives with respect to the free strains, from the virial Σ (∂e/∂r) rᵀ of all pairs.
  Eigen::VectorXd slopes(const Eigen::Matrix3d& virial) const;
  /// Adds the terms with ε² from all pairs. Call this function once, after the last call of add_pair().
  void finish();

 private:
  StrainBasis basis_;  ///< basis of the free strains, divided by ℓ
  BlockMatrix& matrix_;
  Eigen::Matrix3d virial_ = Eigen::Matrix3d::Zero();  ///< Σ (∂e/∂r) rᵀ = V_cell·stress
};

/// Matrix of the quadratic form ε → T:ε², with ε in Mandel's components. T must be symmetric.
Matrix6d of_squared_strain(const Eigen::Matrix3d& tensor);

}  // namespace isojam
