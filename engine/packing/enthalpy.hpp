#pragma once

#include "engine/packing/energy.hpp"

namespace isojam {

struct EnvelopeEvaluation;

/// Enthalpy E + p (V − V₀) − V₀ τ:(F − 1) of a packing whose cell gives way, V₀ the volume that it begins with and F
/// the deformation of its cell since then: what is minimised. Where the cell is fixed it is the energy. The last term
/// is the work of a dead load, which is the stress τ while F is 1; who strains far begins anew from there.
class Enthalpy {
 public:
  /// Of a cell that begins as `reference`.
  Enthalpy(const CellControl& control, const PeriodicCell& reference);

  const CellControl& control() const { return control_; }  ///< what is done to the cell

  /// The evaluation of a packing with p (V − V₀) in its energy, and with derivatives by the free strains behind those
  /// by particles. The residual becomes that of the stress if it is greater: the largest entry of σ + p·1 − τ, or of
  /// what the free strains feel of it, over p; where no pressure is given, over the packing's own.
  Evaluation of(Evaluation evaluation, const Packing& packing) const;
  /// The same for an envelope, in place of the energy.
  EnvelopeEvaluation of(EnvelopeEvaluation evaluation, const Packing& packing) const;
  /// Adds the second derivatives of the load to the corner of those of the energy.
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
  bool sheared_;  ///< τ is not zero
};

}  // namespace isojam
