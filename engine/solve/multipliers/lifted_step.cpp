#include "engine/solve/multipliers/lifted_step.hpp"

#include <algorithm>
#include <limits>

#include "engine/packing/strain_border.hpp"
#include "engine/solve/minimise/descent.hpp"

namespace isojam {

namespace {

/// An iterative solution with this accuracy limits the factor by which one step reduces the error.
constexpr double accuracy = 1e-3;

/// Size that an eigenvalue can have due to rounding errors if its exact value is zero.
double resolved(const BlockMatrix& matrix) {
  double largest = 0;
  for (const Matrix6d& block : matrix.diagonal) largest = std::max(largest, block.diagonal().maxCoeff());
  return 64 * std::numeric_limits<double>::epsilon() * largest;
}

}  // namespace

std::optional<EnvelopeState> lifted_step(const EnvelopeState& state, double stiffness, double shift, double longest,
                                         EnvelopeEvaluator& evaluator, DefiniteSolver& solver, MinimiseWork& work) {
  std::vector<PairHessian> curvatures;
  curvatures.reserve(state.value.contacts.size());
  BlockMatrix hessian;
  hessian.diagonal.assign(state.packing.poses.size(), Matrix6d::Zero());
  StrainBorder border(evaluator.load().control().cell, state.packing.size(), hessian);
  Eigen::VectorXd gradient = state.value.gradient;
  Eigen::Matrix3d virial = Eigen::Matrix3d::Zero();
  const auto shift_of = [&](const EnvelopeContact& contact) {
    return to_lab(state.packing.poses[contact.pair.b], contact.at->shift);
  };
  for (const EnvelopeContact& contact : state.value.contacts) {
    if (!contact.at->touching) continue;
    const PairHessian& h = curvatures.emplace_back(contact.at->curvature(stiffness));
    const Vector6d w = shift_of(contact);
    hessian.add_pair(contact.pair.a, contact.pair.b, h.aa, h.ab, h.bb);
    border.add_pair(contact.pair.a, contact.pair.b, h, contact.at->gradient_b.head<3>(), contact.displacement);
    const Vector6d of_b = h.bb * w;
    gradient.segment<6>(6 * contact.pair.a) -= h.ab * w;
    gradient.segment<6>(6 * contact.pair.b) -= of_b;
    virial += of_b.head<3>() * contact.displacement.transpose();
  }
  border.finish();
  evaluator.load().add_to(hessian, state.packing);
  if (hessian.strains() > 0) gradient.tail(hessian.strains()) -= border.slopes(virial);
  const auto solution = solver.solve(hessian, std::max(shift, resolved(hessian)), gradient, accuracy, work);
  if (!solution) return std::nullopt;
  const Eigen::VectorXd step = -*solution;
  if (!(largest_displacement(step) <= longest)) return std::nullopt;
  const Eigen::Matrix3d strain = strain_of(step, state.packing.size());
  std::vector<ContactMultiplier> forces;
  auto curvature = curvatures.begin();
  for (const EnvelopeContact& contact : state.value.contacts) {
    if (!contact.at->touching) continue;
    const PairHessian& h = *curvature++;
    const Vector6d of_a = step.segment<6>(6 * contact.pair.a);
    const Vector6d of_ghost = step_of_b(contact, step, strain) - shift_of(contact);
    const Vector6d change = h.ab.transpose() * of_a + h.bb * of_ghost;
    forces.push_back(
        {contact.pair, contact.at->wrench + to_body(state.packing.poses[contact.pair.b], change), Vector6d::Zero()});
  }
  return evaluator.at(moved(state.packing, step), forces);
}

}  // namespace isojam
