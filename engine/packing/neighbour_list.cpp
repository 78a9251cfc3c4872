#include "engine/packing/neighbour_list.hpp"

#include <stdexcept>
#include <utility>

namespace isojam {

namespace {

/// Skin of the neighbour list in circumradii: wide enough that a minimisation rebuilds it seldom, narrow enough that
/// few listed pairs are out of reach.
constexpr double skin_in_circumradii = 0.15;

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

}  // namespace

void NeighbourList::refresh(const Packing& packing) {
  const std::size_t n = packing.poses.size();
  bool valid = solid_ == packing.solid && side_ == packing.cell.side() && positions_.size() == n;
  for (std::size_t i = 0; valid && i < n; ++i)
    valid = (packing.poses[i].position - positions_[i]).squaredNorm() < skin_ * skin_ / 4;
  if (valid) return;
  if (!(packing.cell.side() > least_side(*packing.solid)))
    throw std::invalid_argument("the cell is so small that a particle can touch two images of another");
  const bool same_system = solid_ == packing.solid && positions_.size() == n;
  skin_ = skin_in_circumradii * packing.solid->circumradius();
  std::vector<NeighbourPair> pairs = find_neighbours(packing, 2 * packing.solid->circumradius() + skin_);
  axes_ = same_system ? carried_over(pairs_, axes_, pairs) : std::vector<SeparatingAxis>(pairs.size());
  pairs_ = std::move(pairs);
  positions_.resize(n);
  for (std::size_t i = 0; i < n; ++i) positions_[i] = packing.poses[i].position;
  side_ = packing.cell.side();
  solid_ = packing.solid;
}

}  // namespace isojam
