#include "engine/vibration/strict.hpp"

#include <Eigen/LU>

#include "engine/solve/factor/block_cholesky.hpp"
#include "engine/solve/factor/dense.hpp"
#include "engine/solve/multipliers/multipliers.hpp"
#include "engine/vibration/dynamical_matrix.hpp"
#include "engine/vibration/pinned_matrix.hpp"

namespace isojam {

BlockMatrix enthalpy_hessian(const Packing& packing, const CellControl& control, Precision precision) {
  BlockMatrix hessian = PackingEnergy().second_order(packing, 0, precision, control.cell).hessian;
  Enthalpy(control, packing.cell).add_to(hessian, packing);
  return hessian;
}

CellControl strict_control(const Evaluation& evaluation) { return {CellFreedom::free, evaluation.pressure}; }

Stability strict_stability(const Packing& packing, const Evaluation& evaluation, Precision precision) {
  const BlockMatrix hessian = enthalpy_hessian(packing, strict_control(evaluation), precision);
  return assess(hessian, {}, unbalanced_torque(evaluation, packing.solids));
}

bool is_strictly_jammed(const Stability& stability) {
  if (stability.verdict == Verdict::stable) return true;
  return stability.verdict == Verdict::marginal &&
         stability.zero - 3 <= 6 * static_cast<int>(stability.near_rattlers.size());
}

std::optional<SoftStrain> softest_strain(const BlockMatrix& hessian) {
  const Eigen::Index n = 6 * Eigen::Index{hessian.size()}, strains = hessian.strains();
  BlockMatrix particles = hessian;
  particles.border.resize(n, 0);
  particles.corner.resize(0, 0);
  BlockCholesky factor;
  const double pinned = norm_bound(particles);
  if (!factor.factorise(pinned_matrix(particles, pinned, Pinning::translations_and_untouched), 0)) return std::nullopt;
  Eigen::MatrixXd response(n, strains), reaction(n, strains);
  for (Eigen::Index k = 0; k < strains; ++k) {
    Eigen::VectorXd force = -hessian.border.col(k);
    force.head<3>().setZero();  // pinned
    response.col(k) = factor.solve(force);
    reaction.col(k) = particles * Eigen::VectorXd(response.col(k));
  }
  const Eigen::MatrixXd cross = hessian.border.transpose() * response;
  const SymmetricEigen modes =
      symmetric_eigen(hessian.corner + cross + cross.transpose() + response.transpose() * reaction);
  if (modes.values.size() == 0) return std::nullopt;
  SoftStrain softest{Eigen::VectorXd(n + strains), modes.values[0]};
  softest.step.head(n) = response * modes.vectors.col(0);
  softest.step.tail(strains) = modes.vectors.col(0);
  return softest;
}

FreedCell free_cell(const Packing& packing, double distance, const MinimiseOptions& options) {
  PackingEnergy energy;
  MinimumSearchOptions search;
  search.minimise = options;
  search.minimise.control = strict_control(energy.evaluate(packing, Precision::double_double));
  search.modes.lowest = 4;
  Packing freed = packing;
  follow_load(freed, distance, energy, search.minimise);
  FreedCell found{relax_to_minimum(freed, search)};
  const Packing& after = found.result.packing;
  const Evaluation value = energy.evaluate(after, Precision::double_double);
  const Eigen::Matrix3d f = after.cell.vectors().high * packing.cell.vectors().high.inverse();
  found.strain = (f.transpose() * f - Eigen::Matrix3d::Identity()).norm() / 2;
  found.density = after.density();
  found.energy_per_particle = value.energy / after.size();
  found.pressure = value.pressure;
  found.deviator = deviator_of(value);
  return found;
}

}  // namespace isojam
