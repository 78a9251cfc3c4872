#include "engine/packing/energy.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <tuple>

namespace isojam {

namespace {

/// Skin of the neighbour list in circumradii: wide enough that a minimisation rebuilds it seldom, narrow enough that
/// few listed pairs are out of reach.
constexpr double skin_in_circumradii = 0.15;

auto canonical_key(const NeighbourPair& p) { return std::make_tuple(p.a, p.b, p.shift[0], p.shift[1], p.shift[2]); }

/// Axes of the pairs that stay, by a merge of two lists in canonical order.
std::vector<SeparatingAxis> carried_over(const std::vector<NeighbourPair>& old_pairs,
                                         const std::vector<SeparatingAxis>& old_axes,
                                         const std::vector<NeighbourPair>& pairs) {
  std::vector<SeparatingAxis> axes(pairs.size());
  std::size_t old = 0;
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    while (old < old_pairs.size() && canonical_key(old_pairs[old]) < canonical_key(pairs[k])) ++old;
    if (old < old_pairs.size() && canonical_key(old_pairs[old]) == canonical_key(pairs[k])) axes[k] = old_axes[old];
  }
  return axes;
}

/// Sums that an evaluation needs on the way.
struct Accumulator {
  double force = 0;
  std::vector<double> stiffness;  ///< per particle, Σ ½ |∇V|² over its contacts
};

/// Adds one contact, lab frame. ∂E/∂x_A = (V/2) S_A, ∂E/∂θ_A = (V/2) M_A.
void add_contact(const Packing& packing, const NeighbourPair& pair, const Overlap& overlap, Evaluation& sum,
                 Accumulator& on_the_way) {
  const Eigen::Vector3d r = displacement(packing, pair);
  const double radius = packing.solid->gyration_radius();
  const Eigen::Vector3d dx = overlap.volume / 2 * overlap.area;
  const Eigen::Vector3d dtheta = overlap.volume / 2 * overlap.moment;
  sum.energy += overlap.volume * overlap.volume / 4;
  sum.gradient.segment<3>(6 * pair.a) += dx;
  sum.gradient.segment<3>(6 * pair.a + 3) += dtheta / radius;
  sum.gradient.segment<3>(6 * pair.b) -= dx;
  sum.gradient.segment<3>(6 * pair.b + 3) += (r.cross(dx) - dtheta) / radius;
  sum.stress -= dx * r.transpose();
  on_the_way.force += dx.norm();
  const double square = overlap.area.squaredNorm();
  const Eigen::Vector3d moment_b = r.cross(overlap.area) - overlap.moment;
  on_the_way.stiffness[pair.a] += (square + overlap.moment.squaredNorm() / (radius * radius)) / 2;
  on_the_way.stiffness[pair.b] += (square + moment_b.squaredNorm() / (radius * radius)) / 2;
  ++sum.contacts;
}

/// A flat contact of area A whose section line crosses its middle resists tilt about axes in its plane: V_τ ≈ A^(3/2)/5
/// there, and ½ V_τ² = A³/50. Contacts of lower order have so small an area that it vanishes beside ½ |∇V|².
Eigen::Matrix3d tilt_stiffness(const Eigen::Vector3d& area, double radius) {
  const double square = area.squaredNorm();
  const Eigen::Matrix3d in_plane = Eigen::Matrix3d::Identity() - area * area.transpose() / square;
  return square * std::sqrt(square) / (50 * radius * radius) * in_plane;
}

double largest_imbalance(const Eigen::VectorXd& gradient) {
  double largest = 0;
  for (Eigen::Index k = 0; k < gradient.size(); k += 3) largest = std::max(largest, gradient.segment<3>(k).norm());
  return largest;
}

}  // namespace

void PackingEnergy::refresh(const Packing& packing) {
  const std::size_t n = packing.poses.size();
  bool valid = list_solid_ == packing.solid && list_side_ == packing.cell.side() && list_positions_.size() == n;
  for (std::size_t i = 0; valid && i < n; ++i)
    valid = (packing.poses[i].position - list_positions_[i]).squaredNorm() < skin_ * skin_ / 4;
  if (valid) return;
  if (!(packing.cell.side() > least_side(*packing.solid)))
    throw std::invalid_argument("the cell is so small that a particle can touch two images of another");
  const bool same_system = list_solid_ == packing.solid && list_positions_.size() == n;
  skin_ = skin_in_circumradii * packing.solid->circumradius();
  std::vector<NeighbourPair> pairs = find_neighbours(packing, 2 * packing.solid->circumradius() + skin_);
  axes_ = same_system ? carried_over(pairs_, axes_, pairs) : std::vector<SeparatingAxis>(pairs.size());
  pairs_ = std::move(pairs);
  overlaps_.resize(pairs_.size());
  list_positions_.resize(n);
  for (std::size_t i = 0; i < n; ++i) list_positions_[i] = packing.poses[i].position;
  list_side_ = packing.cell.side();
  list_solid_ = packing.solid;
}

void PackingEnergy::overlap_all(const Packing& packing, std::span<PairHessian> hessians) {
  place_all(packing, placed_);
  totals_ += overlap_pairs(packing, placed_, pairs_, axes_, overlaps_, hessians);
  ++evaluations_;
}

Evaluation PackingEnergy::evaluate(const Packing& packing) {
  refresh(packing);
  overlap_all(packing, {});
  Evaluation result;
  result.gradient = Eigen::VectorXd::Zero(6 * packing.size());
  Accumulator on_the_way{0, std::vector<double>(packing.poses.size(), 0.0)};
  for (std::size_t k = 0; k < pairs_.size(); ++k) {
    if (overlaps_[k].touching()) add_contact(packing, pairs_[k], overlaps_[k], result, on_the_way);
  }
  result.stress /= packing.cell.volume();
  result.pressure = -result.stress.trace() / 3;
  const double imbalance = largest_imbalance(result.gradient);
  if (result.contacts > 0) result.mean_force = on_the_way.force / static_cast<double>(result.contacts);
  if (imbalance > 0)
    result.residual = result.mean_force > 0 ? imbalance / result.mean_force : std::numeric_limits<double>::infinity();
  if (result.mean_force > 0) {
    // H ≤ Σ ½ ∇V ∇Vᵀ: its largest eigenvalue is at most twice the stiffest diagonal block.
    const double lambda = 2 * *std::max_element(on_the_way.stiffness.begin(), on_the_way.stiffness.end());
    const double ulp = std::numeric_limits<double>::epsilon() * packing.cell.side();
    result.residual_floor = lambda * ulp / result.mean_force;
    result.energy_noise = on_the_way.force * ulp;
  }
  return result;
}

SecondOrder PackingEnergy::second_order(const Packing& packing) {
  refresh(packing);
  hessians_.resize(pairs_.size());
  overlap_all(packing, hessians_);
  SecondOrder result;
  result.hessian.diagonal.assign(packing.poses.size(), Matrix6d::Zero());
  std::vector<BlockMatrix::Block>& blocks = result.hessian.off_diagonal;
  for (std::size_t k = 0; k < pairs_.size(); ++k) {
    if (!overlaps_[k].touching()) continue;
    const NeighbourPair& pair = pairs_[k];
    result.hessian.diagonal[pair.a] += hessians_[k].aa;
    result.hessian.diagonal[pair.b] += hessians_[k].bb;
    if (blocks.empty() || blocks.back().row != pair.a || blocks.back().column != pair.b)
      blocks.push_back({pair.a, pair.b, Matrix6d::Zero()});
    blocks.back().value += hessians_[k].ab;
    result.tilts.push_back(
        {static_cast<int>(blocks.size()) - 1, tilt_stiffness(overlaps_[k].area, packing.solid->gyration_radius())});
  }
  return result;
}

std::vector<Contact> PackingEnergy::contacts(const Packing& packing) {
  refresh(packing);
  overlap_all(packing, {});
  std::vector<Contact> result;
  for (std::size_t k = 0; k < pairs_.size(); ++k) {
    if (!overlaps_[k].touching()) continue;
    const NeighbourPair& pair = pairs_[k];
    const Eigen::Vector3d d = displacement(packing, pair);
    const Eigen::Quaterniond &a = packing.poses[pair.a].orientation, &b = packing.poses[pair.b].orientation;
    Contact contact{pair, d, relative_pose(a, b, d), overlaps_[k]};
    contact.overlap.area = a.conjugate() * overlaps_[k].area;
    contact.overlap.moment = a.conjugate() * overlaps_[k].moment;
    result.push_back(contact);
  }
  return result;
}

}  // namespace isojam
