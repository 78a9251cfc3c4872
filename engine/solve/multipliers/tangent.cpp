#include "engine/solve/multipliers/tangent.hpp"

#include "engine/packing/strain_border.hpp"

namespace isojam {

namespace {

constexpr double accuracy = 0.01;  // the response is only a prediction

Vector6d stretched(const EnvelopeContact& contact, const Eigen::Matrix3d& imposed) {
  return joined(imposed * contact.displacement, Eigen::Vector3d::Zero());
}

/// Change of the gradient due to the strain `imposed`. The term of second order in the free strains is neglected: it is
/// a hydrostatic stress, to which these strains do not couple.
Eigen::VectorXd change_of_gradient(const EnvelopeState& from, const Eigen::Matrix3d& imposed, CellFreedom cell) {
  BlockMatrix unused;
  const StrainBorder border(cell, from.packing.size(), unused);
  Eigen::VectorXd change = Eigen::VectorXd::Zero(from.value.gradient.size());
  Eigen::Matrix3d virial = Eigen::Matrix3d::Zero();
  for (const EnvelopeContact& contact : from.value.contacts) {
    const PairHessian h = contact.at->curvature();
    const Vector6d of_b = h.bb * stretched(contact, imposed);
    change.segment<6>(6 * contact.pair.a) += h.ab * stretched(contact, imposed);
    change.segment<6>(6 * contact.pair.b) += of_b;
    virial += of_b.head<3>() * contact.displacement.transpose();
  }
  change.tail(unused.strains()) = border.slopes(virial);
  return change;
}

}  // namespace

Tangent tangent(const EnvelopeState& from, const Eigen::Matrix3d& imposed, double shift, double longest,
                EnvelopeEvaluator& evaluator, DefiniteSolver& solver, MinimiseWork& work) {
  const CellFreedom cell = evaluator.load().control().cell;
  const Eigen::Index particles = 6 * Eigen::Index{from.packing.size()}, all = from.value.gradient.size();
  Eigen::VectorXd change = Eigen::VectorXd::Zero(all);
  if (frees_volume(cell)) {
    change.tail(all - particles) = from.value.gradient.tail(all - particles);
  } else {
    change = change_of_gradient(from, imposed, cell);
  }
  Tangent result{Eigen::VectorXd::Zero(all), forces_of(from.value)};
  ++work.hessians;
  if (const auto response = solver.solve(evaluator.curvature(from), shift, change, accuracy, work))
    result.step = limited(-*response, longest);
  const Eigen::Matrix3d strain = strain_of(result.step, from.packing.size());
  for (std::size_t k = 0; k < result.forces.size(); ++k) {
    const EnvelopeContact& contact = from.value.contacts[k];
    const Vector6d a = result.step.segment<6>(6 * contact.pair.a);
    const Vector6d b = step_of_b(contact, result.step, strain) + stretched(contact, imposed);
    result.forces[k].shift = to_body(from.packing.poses[contact.pair.b], contact.at->shift_change(a, b));
  }
  return result;
}

}  // namespace isojam
