#pragma once

#include <Eigen/Core>

#include "engine/packing/block_matrix.hpp"
#include "engine/packing/cell/control.hpp"
#include "engine/packing/pair_energy.hpp"

namespace isojam {

/// Borders second derivatives with those by the strains that are free. The energy of a pair depends on its centres
/// through r = x_b − x_a, on which strain acts as exp(ε) r = r + ε r + ½ ε² r + …: with ℓ·ε for coordinates
/// (control.hpp),
///   ∂²E/∂q∂ε = Σ (∂²e/∂q∂r) ∂r/∂ε,   ∂²E/∂ε² = Σ ∂r/∂ε·(∂²e/∂r²) ∂r/∂ε + ½ (∂e/∂r)·∂²(ε² r)/∂ε².
/// Does nothing where none is free.
class StrainBorder {
 public:
  /// Sets border and corner of `matrix`, which must outlive this, to zero.
  StrainBorder(CellFreedom cell, int particles, BlockMatrix& matrix);

  /// A pair with second derivatives `h`, slope ∂e/∂r and displacement r; lab frame.
  void add_pair(int a, int b, const PairHessian& h, const Eigen::Vector3d& slope, const Eigen::Vector3d& r);
  /// Derivatives by the free strains of what has this virial, Σ (∂e/∂r) rᵀ.
  Eigen::VectorXd slopes(const Eigen::Matrix3d& virial) const;
  /// Adds what is of second order in ε. After the last pair.
  void finish();

 private:
  StrainBasis basis_;  ///< over ℓ
  BlockMatrix& matrix_;
  Eigen::Matrix3d virial_ = Eigen::Matrix3d::Zero();  ///< Σ (∂e/∂r) rᵀ = V_cell·stress
};

/// Quadratic form of ε in Mandel's components: T:ε², T symmetric.
Matrix6d of_squared_strain(const Eigen::Matrix3d& tensor);

}  // namespace isojam
