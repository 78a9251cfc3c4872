#pragma once

#include "engine/packing/energy.hpp"

namespace isojam {

struct EnvelopeEvaluation;

/// Enthalpy E + p (V − V₀) − V₀ τ:(F − 1) of a packing in a variable cell: the function that is minimised. V₀ is the
/// initial volume and F the deformation of the cell since then. In a fixed cell it equals the energy. The last term is
/// the work of a dead load. It equals a stress τ only near F = 1, so make a new Enthalpy with the present cell as
/// reference after a large strain.
class Enthalpy {
 public:
  /// An enthalpy whose reference is the cell `reference`.
  Enthalpy(const CellControl& control, const PeriodicCell& reference);

  const CellControl& control() const { return control_; }  ///< freedom and load of the cell

  /// The evaluation with p (V − V₀) in its energy, and with derivatives with respect to the free strains after those of
  /// the particles. The residual becomes that of the stress if that is larger: the largest entry of σ + p·1 − τ,
  /// projected on the free strains, divided by p. If no pressure is prescribed, it is divided by the packing's own.
  Evaluation of(Evaluation evaluation, const Packing& packing) const;
  /// The same for an envelope instead of the energy.
  EnvelopeEvaluation of(EnvelopeEvaluation evaluation, const Packing& packing) const;
  /// Adds the second derivatives of the load to the corner of the energy's Hessian.
  void add_to(BlockMatrix& hessian, const Packing& packing) const;

 private:
  double pressure() const { return frees_volume(control_.cell) ? control_.pressure : 0; }
  /// p (V − V₀) − V₀ τ:(F − 1).
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
