#pragma once

#include "engine/packing/energy.hpp"

namespace isojam {

struct EnvelopeEvaluation;

/// Enthalpy E + p (V − V₀) − V₀ τ:(F − 1) of a packing. All minimisers minimise this function. For a fixed cell, it is
/// E. V is the volume of the cell, V₀ is the volume of the reference cell, and F is the deformation from the reference
/// cell to the present cell. CellControl defines p and τ. It also lists which of the three terms are used for each set
/// of free strains (CellFreedom, cell/control.hpp). The last term is the potential energy of the load τ, a force per
/// unit area of the reference cell. It is minus the work of this load. At the minimum of a free cell, the stress is
/// −p·1 + (V₀/V) sym(F τ). If F is close to 1, this is close to −p·1 + τ. After a large strain, make a new Enthalpy
/// with the present cell as the reference.
class Enthalpy {
 public:
  /// Makes an enthalpy with the reference cell `reference`.
  Enthalpy(const CellControl& control, const PeriodicCell& reference);

  const CellControl& control() const { return control_; }

  /// Converts an evaluation of the energy to an evaluation of the enthalpy. Adds the energy of the load, and appends
  /// the derivatives with respect to the free strains (see CellFreedom) to the gradient. The new residual is the larger
  /// of the residual of the forces and the residual of the stress. The residual of the stress is max |D_ij| / P. D is σ
  /// + p·1 − (V₀/V) sym(F τ), projected on the free strains, where σ is Evaluation::stress. If the volume is free, P
  /// is the prescribed pressure p. Otherwise, D has no term p·1, and P is the pressure of the packing. With cohesion, P
  /// is at least Evaluation::repulsive_pressure. If P ≤ 0 and D ≠ 0, the residual is infinite.
  Evaluation of(Evaluation evaluation, const Packing& packing) const;
  /// Does the same for the evaluation of an envelope (envelope/envelope.hpp): adds the energy of the load, and appends
  /// the derivatives with respect to the free strains. An envelope has no residual.
  EnvelopeEvaluation of(EnvelopeEvaluation evaluation, const Packing& packing) const;
  /// Adds the second derivatives of the load to BlockMatrix::corner of the Hessian of the energy.
  void add_to(BlockMatrix& hessian, const Packing& packing) const;

 private:
  double pressure() const { return frees_volume(control_.cell) ? control_.pressure : 0; }
  /// The energy of the load, p (V − V₀) − V₀ τ:(F − 1).
  double load_energy(const PeriodicCell& cell) const;
  Eigen::Matrix3d load_gradient(const PeriodicCell& cell) const;
  Eigen::VectorXd strain_gradient(const Eigen::Matrix3d& stress, const Packing& packing) const;

  CellControl control_;
  StrainBasis basis_;
  PeriodicCell reference_;
  DoubleDouble reference_volume_;
  bool has_deviator_;  ///< true if the cell is free and τ is not zero
};

}  // namespace isojam
