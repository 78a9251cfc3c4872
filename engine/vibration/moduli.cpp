#include "engine/vibration/moduli.hpp"

#include <cmath>
#include <tuple>

#include "engine/packing/cell/strain.hpp"
#include "engine/packing/strain_border.hpp"
#include "engine/solve/factor/block_cholesky.hpp"
#include "engine/solve/factor/dense.hpp"
#include "engine/vibration/dynamical_matrix.hpp"
#include "engine/vibration/pinned_matrix.hpp"

namespace isojam {

namespace {

using Eigen::Index;
using Eigen::Matrix3d;
using Eigen::Vector3d;

/// Displacement x_b − x_a of every off-diagonal block. The blocks and the contacts are sorted by pair, so one pass over
/// both is enough.
std::vector<Vector3d> displacements(const Packing& packing, const BlockMatrix& hessian,
                                    std::span<const Contact> contacts) {
  std::vector<Vector3d> result;
  result.reserve(hessian.off_diagonal.size());
  const auto pair_of = [](const Contact& contact) { return std::tie(contact.pair.a, contact.pair.b); };
  auto contact = contacts.begin();
  for (const BlockMatrix::Block& block : hessian.off_diagonal) {
    const auto pair = std::tie(block.row, block.column);
    while (contact != contacts.end() && pair_of(*contact) < pair) ++contact;
    const bool listed = contact != contacts.end() && pair_of(*contact) == pair;
    const Vector3d d = packing.poses[static_cast<std::size_t>(block.column)].position -
                       packing.poses[static_cast<std::size_t>(block.row)].position;
    result.push_back(listed ? contact->displacement : packing.cell.nearest_image(d));
  }
  return result;
}

/// Affine (Born) part of the elastic response.
struct Affine {
  Matrix6d stiffness = Matrix6d::Zero();  ///< d²E/dε², not divided by V
  Eigen::MatrixXd forces;                 ///< Ξ = ∂²E/∂r∂ε, 6N × 6
};

/// The energy of a pair depends on positions only through r = x_b − x_a. Its derivatives with respect to r equal the
/// derivatives with respect to x_b, and the negative derivatives with respect to x_a. Second derivatives therefore
/// follow from the block H_ab of the Hessian. The second-order term ½ ε² r of exp(ε) r adds the work of the stress, V
/// σ:ε².
Affine affine_response(const Packing& packing, const BlockMatrix& hessian, std::span<const Contact> contacts,
                       const Evaluation& evaluation) {
  Affine response;
  response.forces = Eigen::MatrixXd::Zero(6 * Index{packing.size()}, 6);
  const std::vector<Vector3d> all = displacements(packing, hessian, contacts);
  for (std::size_t k = 0; k < all.size(); ++k) {
    const BlockMatrix::Block& block = hessian.off_diagonal[k];
    const Strains dr = strained(all[k]);
    response.stiffness -= dr.transpose() * block.value.topLeftCorner<3, 3>() * dr;
    response.forces.middleRows<6>(6 * block.row) += block.value.leftCols<3>() * dr;
    response.forces.middleRows<6>(6 * block.column) -= block.value.topRows<3>().transpose() * dr;
  }
  const Matrix3d stress = packing.cell.volume() * (evaluation.stress + evaluation.stress.transpose()) / 2;
  response.stiffness += of_squared_strain(stress);
  return response;
}

/// Bulk modulus K. For the motion r → e^s r, d²E/ds² = 9V(K − p).
double bulk(const Matrix6d& tensor, double pressure) { return tensor.topLeftCorner<3, 3>().sum() / 9 + pressure; }

}  // namespace

double ElasticTensor::affine_bulk_modulus() const { return bulk(affine, pressure); }
double ElasticTensor::bulk_modulus() const { return bulk(relaxed, pressure); }

std::array<double, 5> ElasticTensor::shear_moduli() const {
  const Eigen::Matrix<double, 6, 5> basis = traceless_basis();
  const Eigen::Matrix<double, 5, 5> traceless = basis.transpose() * relaxed * basis / 2;
  const Eigen::VectorXd eigenvalues = symmetric_eigenvalues(traceless);
  std::array<double, 5> moduli{};
  for (int k = 0; k < 5; ++k) moduli[static_cast<std::size_t>(k)] = eigenvalues[k];
  return moduli;
}

double ElasticTensor::mean_shear_modulus() const {
  const Eigen::Matrix<double, 6, 5> basis = traceless_basis();
  return (basis.transpose() * relaxed * basis).trace() / 10;
}

std::optional<ElasticTensor> elastic_tensor(const Packing& packing, const BlockMatrix& hessian,
                                            std::span<const Contact> contacts, const Evaluation& evaluation) {
  const double bound = norm_bound(hessian);
  if (!(bound > 0) || !std::isfinite(bound)) return std::nullopt;
  BlockCholesky cholesky;
  if (!cholesky.factorise(pinned_matrix(hessian, bound, Pinning::translations_and_untouched), 0)) return std::nullopt;
  const Affine affine = affine_response(packing, hessian, contacts, evaluation);
  Eigen::MatrixXd moves(affine.forces.rows(), 6), reactions(affine.forces.rows(), 6);
  for (int i = 0; i < 6; ++i) {
    Eigen::VectorXd force = -affine.forces.col(i);
    force.head<3>().setZero();  // pinned; the resultant of the other forces is unchanged
    moves.col(i) = cholesky.solve(force);
    reactions.col(i) = hessian * Eigen::VectorXd(moves.col(i));
  }
  // This form is stationary in the displacements, so that their errors enter only squared. The form affine − Ξᵀ D⁺ Ξ
  // would lose most digits to cancellation.
  const Matrix6d cross = affine.forces.transpose() * moves;
  const Matrix6d relaxed = affine.stiffness + cross + cross.transpose() + moves.transpose() * reactions;
  ElasticTensor tensor;
  tensor.pressure = evaluation.pressure;
  const double twice = 2 * packing.cell.volume();
  tensor.affine = (affine.stiffness + affine.stiffness.transpose()) / twice;
  tensor.relaxed = (relaxed + relaxed.transpose()) / twice;
  return tensor;
}

std::optional<PressureSlope> pressure_slope(const Packing& packing, const PressureSlopeOptions& options) {
  PressureSlope slope;
  PackingEnergy energy;
  const auto pressure_at = [&](double density, MinimiseSummary& summary) {
    Packing neighbour = strained_to(packing, density);
    summary = minimise(neighbour, energy, options.minimise);
    return energy.evaluate(neighbour, summary.precision).pressure;
  };
  const double phi = packing.density(), step = options.strain * phi;
  const double below = pressure_at(phi - step, slope.below);
  if (!is_equilibrium(slope.below)) return std::nullopt;
  const double above = pressure_at(phi + step, slope.above);
  if (!is_equilibrium(slope.above)) return std::nullopt;
  slope.bulk_modulus = phi * (above - below) / (2 * step);
  return slope;
}

}  // namespace isojam
