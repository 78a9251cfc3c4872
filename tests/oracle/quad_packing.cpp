#include "tests/oracle/quad_packing.hpp"

#include <algorithm>
#include <tuple>
#include <utility>

#include "engine/geometry/overlap/clipped_overlap.hpp"
#include "engine/packing/cell/strain.hpp"
#include "engine/packing/neighbours.hpp"

namespace isojam::oracle {

namespace {

Quad3 quad_displacement(const Packing& packing, const NeighbourPair& pair) {
  Quad3 r = quad_position(packing.poses[pair.b]) - quad_position(packing.poses[pair.a]);
  const QuadMatrix vectors = widened(packing.cell.vectors());
  for (int c = 0; c < 3; ++c) {
    for (int k = 0; k < 3; ++k) r[c] += vectors[c][k] * pair.shift[k];
  }
  return r;
}

Quad determinant(const QuadMatrix& m) { return dot(m[0], cross(m[1], m[2])); }

/// Adds the forces and energies of all pairs, with the energy quadratic V² + linear V of a pair. Returns the sum of |F|
/// and the number of pairs.
std::pair<Quad, long> add_pairs(const Packing& packing, Quad quadratic, Quad linear, QuadEvaluation& sum) {
  std::pair<Quad, long> forces{0, 0};
  for (const NeighbourPair& pair :
       find_neighbours_brute_force(packing, 2.001 * packing.solids.greatest_circumradius())) {
    const Pose &a = packing.poses[pair.a], &b = packing.poses[pair.b];
    const Quad3 r = quad_displacement(packing, pair);
    const QuadOverlap overlap = clipped_overlap(packing.solids[pair.a], packing.solids[pair.b], relative_pose(a, b, r));
    if (!(overlap.volume > 0)) continue;
    const QuadMatrix q = quad_rotation(a);
    const Quad slope = 2 * quadratic * overlap.volume + linear;
    const Quad3 force = -slope * (q * overlap.area);
    const Quad3 torque = -slope * (q * overlap.moment);
    sum.energy += (quadratic * overlap.volume + linear) * overlap.volume;
    sum.force[pair.a] = sum.force[pair.a] + force;
    sum.force[pair.b] = sum.force[pair.b] - force;
    sum.torque[pair.a] = sum.torque[pair.a] + torque;
    // Torque of the same force about the centre of B.
    sum.torque[pair.b] = sum.torque[pair.b] - torque + cross(r, force);
    for (int c = 0; c < 3; ++c) sum.virial[c] = sum.virial[c] + force[c] * r;
    forces.first += norm(force);
    ++forces.second;
  }
  return forces;
}

}  // namespace

QuadEvaluation evaluate_in_quad(const Packing& packing, const std::optional<Cohesion>& cohesion) {
  QuadEvaluation sum;
  sum.force.resize(packing.poses.size());
  sum.torque.resize(packing.poses.size());
  std::tie(sum.mean_force, sum.contacts) = add_pairs(packing, Quad(1) / 4, 0, sum);
  if (cohesion) {
    const Composition solids = grown(packing.solids, packing.size(), cohesion->range / 2);
    add_pairs({solids, packing.cell, packing.poses}, 0, -Quad(cohesion->strength), sum);
  }
  if (sum.contacts == 0) return sum;
  sum.mean_force /= sum.contacts;
  Quad imbalance = 0;
  for (const Quad3& force : sum.force) imbalance = std::max(imbalance, norm(force));
  for (std::size_t i = 0; i < sum.torque.size(); ++i)
    imbalance = std::max(imbalance, norm(sum.torque[i]) / packing.solids[i].gyration_radius());
  sum.residual = imbalance / sum.mean_force;
  return sum;
}

std::vector<Quad> gradient_of(const QuadEvaluation& evaluation, const Packing& packing) {
  std::vector<Quad> gradient;
  for (std::size_t i = 0; i < packing.poses.size(); ++i) {
    for (const Quad f : evaluation.force[i]) gradient.push_back(-f);
    for (const Quad t : evaluation.torque[i]) gradient.push_back(-t / packing.solids[i].gyration_radius());
  }
  return gradient;
}

std::vector<Quad> gradient_of(const QuadEvaluation& evaluation, const Packing& packing, const CellControl& control) {
  std::vector<Quad> gradient = gradient_of(evaluation, packing);
  const StrainBasis basis = strain_basis(control.cell);
  const Quad load =
      frees_volume(control.cell) ? Quad(control.pressure) * determinant(widened(packing.cell.vectors())) : 0;
  for (Eigen::Index k = 0; k < basis.cols(); ++k) {
    const Eigen::Matrix3d strain = strain_tensor(basis.col(k));
    Quad slope = 0;
    for (int r = 0; r < 3; ++r) {
      slope += load * strain(r, r);
      for (int c = 0; c < 3; ++c) slope += evaluation.virial[r][c] * strain(r, c);
    }
    gradient.push_back(slope / strain_length(packing.size()));
  }
  return gradient;
}

Eigen::VectorXd difference_of_gradients(const Packing& packing, const Eigen::VectorXd& direction, double h) {
  const Packing ahead = moved(packing, h * direction), behind = moved(packing, -h * direction);
  const std::vector<Quad> there = gradient_of(evaluate_in_quad(ahead), ahead),
                          back = gradient_of(evaluate_in_quad(behind), behind);
  Eigen::VectorXd result(direction.size());
  for (Eigen::Index k = 0; k < result.size(); ++k)
    result[k] = static_cast<double>((there[k] - back[k]) / (2 * Quad(h)));
  return result;
}

}  // namespace isojam::oracle
