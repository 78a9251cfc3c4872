#pragma once

#include "engine/packing/energy.hpp"

namespace isojam {

struct EnvelopeEvaluation;

/// Enthalpy E + p (V − V₀) − V₀ τ:(F − 1) of a packing, the function that minimisers minimise. V is the volume of the
/// cell, V₀ is the volume of the reference cell, and F is the deformation from the reference cell to the present cell.
/// CellControl defines p and τ, and lists which terms are used for each CellFreedom. The last term is the work of a
/// dead load. At the minimum, the stress equals −p·1 + τ only if F is near 1. After a large strain, make a new Enthalpy
/// with the present cell as the reference.
class Enthalpy {
 public:
  /// Makes an enthalpy with the reference cell `reference`.
  Enthalpy(const CellControl& control, const PeriodicCell& reference);

  const CellControl& control() const { return control_; }  ///< free strains of the cell and load on the cell

  /// Converts an evaluation of the energy to an evaluation of the enthalpy. The function adds the energy of the load to
  /// the energy, and appends the derivatives with respect to the free strains to the gradient. The new residual is the
  /// larger of the residual of the forces and the residual of the stress. The residual of the stress is the largest
  /// absolute value of the entries of σ + p·1 − (V₀/V) sym(F τ), projected on the free strains, divided by p. σ is
  /// Evaluation::stress. If the volume is not free, p = 0 in the numerator, and p in the denominator is the pressure of
  /// the packing.
  Evaluation of(Evaluation evaluation, const Packing& packing) const;
  /// Converts an evaluation of an envelope in the same way.
  EnvelopeEvaluation of(EnvelopeEvaluation evaluation, const Packing& packing) const;
  /// Adds the second derivatives of the load to BlockMatrix::corner of the Hessian of the energy.
  void add_to(BlockMatrix& hessian, const Packing& packing) const;

 private:
  double pressure() const { return frees_volume(control_.cell) ? control_.pressure : 0; }
  /// The energy of the load, p (V − V₀) − V₀ τ:(F − 1).
  double work(const PeriodicCell& cell) const;
  Eigen::Matrix3d load(const PeriodicCell& cell) const;
  Eigen::VectorXd strain_gradient(const Eigen::Matrix3d& stress, const Packing& packing) const;

  CellControl control_;
  StrainBasis basis_;
  PeriodicCell reference_;
  DoubleDouble reference_volume_;
  bool sheared_;  ///< true if τ is not zero
};

}  // namespace isojam
