#pragma once

#include <Eigen/Core>

#include "engine/packing/block_matrix.hpp"
#include "engine/packing/cell/control.hpp"
#include "engine/packing/pair_energy.hpp"

namespace isojam {

/// Computes the border and the corner of a Hessian: the second derivatives with respect to the free strains. The energy
/// e of a pair depends on the two centres only through r = x_b − x_a. A strain ε changes r to exp(ε) r = r + ε r + ½ ε²
/// r + …. If q are the coordinates of the particles, then
///   ∂²E/∂q∂ε = Σ (∂²e/∂q∂r) ∂r/∂ε
///   ∂²E/∂ε² = Σ [ (∂r/∂ε)·(∂²e/∂r²) ∂r/∂ε + ½ (∂e/∂r)·∂²(ε² r)/∂ε² ],
/// where the sums are over all pairs. The matrix contains derivatives with respect to ℓ·ε (cell/control.hpp). If there
/// are no free strains, this class does nothing.
class StrainBorder {
 public:
  /// Sets the border and the corner of `matrix` to zero. The matrix must outlive this object. `particles` is N.
  StrainBorder(CellFreedom cell, int particles, BlockMatrix& matrix);

  /// Adds the pair (a, b) with the second derivatives `h`, the slope ∂e/∂r and the displacement r, all in the lab
  /// frame.
  void add_pair(int a, int b, const PairHessian& h, const Eigen::Vector3d& slope, const Eigen::Vector3d& r);
  /// First derivatives with respect to the coordinates ℓ·ε, computed from the virial Σ (∂e/∂r) rᵀ of all pairs.
  Eigen::VectorXd slopes(const Eigen::Matrix3d& virial) const;
  /// Adds the last term of ∂²E/∂ε² for all pairs. Call this function once, after the last call of add_pair().
  void finish();

 private:
  StrainBasis basis_;  ///< basis of the free strains, divided by ℓ
  BlockMatrix& matrix_;
  Eigen::Matrix3d virial_ = Eigen::Matrix3d::Zero();  ///< Σ (∂e/∂r) rᵀ = V_cell·stress
};

/// Matrix of the quadratic form ε → T:ε², where ε is in Mandel components. The tensor T must be symmetric.
Matrix6d of_squared_strain(const Eigen::Matrix3d& tensor);

}  // namespace isojam
