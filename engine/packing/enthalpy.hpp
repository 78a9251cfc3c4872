#pragma once

#include "engine/packing/energy.hpp"

namespace isojam {

struct EnvelopeEvaluation;

/// Enthalpy E + p (V − V₀) − V₀ τ:(F − 1) of a packing in a variable cell. Minimisers minimise this function. V₀ is the
/// volume of the reference cell, and F is the deformation from the reference cell to the present cell. In a fixed cell
/// the enthalpy equals the energy. The last term is the work of a dead load. This load corresponds to the stress τ only
/// if F is near 1. After a large strain, make a new Enthalpy with the present cell as the reference.
class Enthalpy {
 public:
  /// Makes an enthalpy with the reference cell `reference`.
  Enthalpy(const CellControl& control, const PeriodicCell& reference);

  const CellControl& control() const { return control_; }  ///< free strains of the cell and load on the cell

  /// Converts an evaluation of the energy to one of the enthalpy. It adds the load to the energy, and appends the
  /// derivatives with respect to the free strains to the gradient. The residual of the stress is the largest entry of σ
  /// + p·1 − τ, projected on the free strains and divided by p. If no pressure is prescribed, it is divided by the
  /// pressure of the packing. If the residual of the stress is larger than the residual of the forces, it replaces the
  /// latter.
  Evaluation of(Evaluation evaluation, const Packing& packing) const;
  /// Converts an evaluation of an envelope in the same way.
  EnvelopeEvaluation of(EnvelopeEvaluation evaluation, const Packing& packing) const;
  /// Adds the second derivatives of the load to BlockMatrix::corner of the Hessian of the energy.
  void add_to(BlockMatrix& hessian, const Packing& packing) const;

 private:
  double pressure() const { return frees_volume(control_.cell) ? control_.pressure : 0; }
  /// The load energy p (V − V₀) − V₀ τ:(F − 1).
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
