#include "engine/packing/enthalpy.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/packing/cell/strain.hpp"
#include "engine/packing/envelope/envelope.hpp"
#include "engine/packing/strain_border.hpp"

namespace isojam {

namespace {

/// Relative rounding error of p (V − V₀).
constexpr double rounding = 4 * std::numeric_limits<double>::epsilon();

/// Largest entry of a stress divided by a pressure. It is infinite if the stress is not 0 but the pressure is 0 or
/// less.
double imbalance(const Vector6d& stress, double pressure) {
  const double largest = strain_tensor(stress).cwiseAbs().maxCoeff();
  if (largest == 0) return 0;
  return pressure > 0 ? largest / pressure : std::numeric_limits<double>::infinity();
}

Eigen::Matrix3d inverse(const PeriodicCell& cell) { return cell.vectors().high.inverse(); }

}  // namespace

Enthalpy::Enthalpy(const CellControl& control, const PeriodicCell& reference)
    : control_(control),
      basis_(strain_basis(control.cell)),
      reference_(reference),
      reference_volume_(reference.volume_double_double()),
      has_deviator_(control.cell == CellFreedom::free && !control.deviator.isZero(0)) {}

double Enthalpy::load_energy(const PeriodicCell& cell) const {
  const double by_pressure = pressure() * (cell.volume_double_double() - reference_volume_).high;
  if (!has_deviator_) return by_pressure;
  const Eigen::Matrix3d change = (cell.vectors().high - reference_.vectors().high) * inverse(reference_);
  return by_pressure - reference_.volume() * control_.deviator.cwiseProduct(change).sum();
}

/// V₀ F τ. A strain ε changes F to F + ε F + ½ ε² F. The derivative of the work V₀ τ:(F − 1) with respect to ε is
/// therefore the symmetric part of this matrix.
Eigen::Matrix3d Enthalpy::load_gradient(const PeriodicCell& cell) const {
  if (!has_deviator_) return Eigen::Matrix3d::Zero();
  return reference_.volume() * cell.vectors().high * inverse(reference_) * control_.deviator;
}

/// Derivatives of the enthalpy with respect to the coordinates ℓ·ε of the free strains.
Eigen::VectorXd Enthalpy::strain_gradient(const Eigen::Matrix3d& stress, const Packing& packing) const {
  Vector6d excess = strain_components(stress + pressure() * Eigen::Matrix3d::Identity());
  if (has_deviator_) excess -= strain_components(load_gradient(packing.cell)) / packing.cell.volume();
  return packing.cell.volume() / strain_length(packing.size()) * (basis_.transpose() * excess);
}

Evaluation Enthalpy::of(Evaluation evaluation, const Packing& packing) const {
  const Eigen::Index particles = 6 * Eigen::Index{packing.size()}, strains = basis_.cols();
  if (strains == 0) return evaluation;
  const Eigen::VectorXd gradient = strain_gradient(evaluation.stress, packing);
  evaluation.gradient.conservativeResize(particles + strains);
  evaluation.gradient.tail(strains) = gradient;
  const Vector6d stress = strain_length(packing.size()) / packing.cell.volume() * (basis_ * gradient);
  double scale = frees_volume(control_.cell) ? pressure() : evaluation.pressure;
  if (evaluation.repulsive_pressure) scale = std::max(scale, *evaluation.repulsive_pressure);
  evaluation.residual = std::max(evaluation.residual, imbalance(stress, scale));
  evaluation.load_energy = load_energy(packing.cell);
  evaluation.energy += evaluation.load_energy;
  evaluation.energy_noise += rounding * std::abs(evaluation.load_energy);
  return evaluation;
}

EnvelopeEvaluation Enthalpy::of(EnvelopeEvaluation evaluation, const Packing& packing) const {
  const Eigen::Index particles = 6 * Eigen::Index{packing.size()}, strains = basis_.cols();
  if (strains == 0) return evaluation;
  evaluation.gradient.conservativeResize(particles + strains);
  evaluation.gradient.tail(strains) = strain_gradient(evaluation.virial / packing.cell.volume(), packing);
  const double load = load_energy(packing.cell);
  evaluation.value += load;
  evaluation.noise += rounding * std::abs(load);
  return evaluation;
}

void Enthalpy::add_to(BlockMatrix& hessian, const Packing& packing) const {
  if (!frees_volume(control_.cell)) return;
  // The second-order term of V exp(tr ε), the volume after a strain ε.
  const Eigen::VectorXd trace =
      basis_.transpose() * (std::sqrt(3.0) * trace_direction()) / strain_length(packing.size());
  hessian.corner += pressure() * packing.cell.volume() * trace * trace.transpose();
  if (!has_deviator_) return;
  const Eigen::Matrix3d bent = load_gradient(packing.cell);
  const double length = strain_length(packing.size());
  hessian.corner -= basis_.transpose() * of_squared_strain((bent + bent.transpose()) / 2) * basis_ / (length * length);
}

}  // namespace isojam
