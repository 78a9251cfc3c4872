#include "engine/packing/neighbour_list.hpp"

#include <Eigen/LU>
#include <stdexcept>
#include <utility>

#include "engine/packing/pair_search.hpp"

namespace isojam {

namespace {

/// Skin of the neighbour list, in units of the mean circumradius. It is so large that a minimisation rarely makes a new
/// list, and so small that the circumscribed spheres of most listed pairs intersect.
constexpr double skin_in_circumradii = 0.15;

/// Separating axes of a new list: those of the old list for pairs that both lists contain, and none for other pairs.
std::vector<SeparatingAxis> carried_over(const std::vector<NeighbourPair>& old_pairs,
                                         const std::vector<SeparatingAxis>& old_axes,
                                         const std::vector<NeighbourPair>& pairs) {
  std::vector<SeparatingAxis> axes(pairs.size());
  PairSearch<NeighbourPair> old(old_pairs);
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    if (const NeighbourPair* found = old.find(pairs[k])) axes[k] = old_axes[found - old_pairs.data()];
  }
  return axes;
}

}  // namespace

/// Since the list was made, centres have moved from x to F x + u, and displacements from r to F r + u_b − u_a, where F
/// is the deformation of the cell. A pair outside the list had |r| ≥ reach + skin. Its distance is now at least |F r| −
/// 2 max |u|, and |F r| ≥ (1 − |F − 1|) |r|. The list is valid if this is larger than the reach. The condition is
/// strictest for pairs of the largest particles.
bool NeighbourList::is_valid(const Packing& packing) const {
  const std::size_t n = packing.poses.size();
  if (!(solids_ == packing.solids) || !cell_ || positions_.size() != n) return false;
  Eigen::Matrix3d f = Eigen::Matrix3d::Identity();
  double most = skin_ / 2;
  if (!(*cell_ == packing.cell)) {
    f = packing.cell.vectors().high * cell_->vectors().high.inverse();
    most = ((1 - (f - Eigen::Matrix3d::Identity()).norm()) * (reach_ + skin_) - reach_) / 2;
    if (!(most > 0) || !is_legal(packing.cell, packing.solids.widest())) return false;
  }
  for (std::size_t i = 0; i < n; ++i) {
    if (!((packing.poses[i].position - f * positions_[i]).squaredNorm() < most * most)) return false;
  }
  return true;
}

void NeighbourList::refresh(const Packing& packing) {
  if (is_valid(packing)) return;
  if (!is_legal(packing.cell, packing.solids.widest()))
    throw std::invalid_argument("the cell is so small that a particle can touch two images of another");
  const std::size_t n = packing.poses.size();
  const bool same_system = solids_ == packing.solids && positions_.size() == n;
  reach_ = 2 * packing.solids.greatest_circumradius();
  skin_ = skin_in_circumradii * packing.solids.mean_circumradius();
  std::vector<NeighbourPair> pairs =
      packing.solids.is_uniform() ? find_neighbours(packing, reach_ + skin_) : find_in_reach(packing, skin_);
  axes_ = same_system ? carried_over(pairs_, axes_, pairs) : std::vector<SeparatingAxis>(pairs.size());
  pairs_ = std::move(pairs);
  positions_.resize(n);
  for (std::size_t i = 0; i < n; ++i) positions_[i] = packing.poses[i].position;
  cell_ = packing.cell;
  solids_ = packing.solids;
}

}  // namespace isojam
