#include "engine/packing/neighbours.hpp"

#include <algorithm>
#include <cmath>

namespace isojam {

namespace {

/// Appends every image of b within reach of a.
void append_images(const Packing& packing, int a, int b, double reach, std::vector<NeighbourPair>& pairs) {
  const Eigen::Vector3d d =
      packing.poses[static_cast<std::size_t>(b)].position - packing.poses[static_cast<std::size_t>(a)].position;
  const Eigen::Vector3i nearest = packing.cell.nearest_shift(d);
  const Eigen::Vector3d nearest_d = d + packing.cell.translation(nearest);
  // The first image is within half a cell along each lattice vector: farther ones matter only while that is in reach.
  Eigen::Vector3i spread;
  for (int c = 0; c < 3; ++c) {
    const double height = packing.cell.heights()[c];
    spread[c] = reach > height / 2 ? static_cast<int>(std::floor(reach / height + 0.5)) : 0;
  }
  for (int i = -spread[0]; i <= spread[0]; ++i) {
    for (int j = -spread[1]; j <= spread[1]; ++j) {
      for (int k = -spread[2]; k <= spread[2]; ++k) {
        const Eigen::Vector3i extra(i, j, k);
        if ((nearest_d + packing.cell.translation(extra)).squaredNorm() < reach * reach)
          pairs.push_back({a, b, nearest + extra});
      }
    }
  }
}

/// From the `first` on, in order of (a, b, shift).
void sort_canonically(std::vector<NeighbourPair>& pairs, std::size_t first) {
  std::sort(pairs.begin() + static_cast<std::ptrdiff_t>(first), pairs.end(),
            [](const auto& p, const auto& q) { return canonical_key(p) < canonical_key(q); });
}

/// Particles by cell of a grid with `cells` ≥ 3 cells along each lattice vector.
class CellGrid {
 public:
  CellGrid(const Packing& packing, const Eigen::Vector3i& cells)
      : cells_(cells), members_(static_cast<std::size_t>(cells[0]) * cells[1] * cells[2]) {
    for (int i = 0; i < packing.size(); ++i) {
      const Eigen::Vector3d u = packing.cell.fractional(packing.poses[static_cast<std::size_t>(i)].position);
      Eigen::Vector3i where;
      for (int c = 0; c < 3; ++c)
        where[c] = std::min(static_cast<int>((u[c] - std::floor(u[c])) * cells[c]), cells[c] - 1);
      home_.push_back(where);
      members_[index(where)].push_back(i);
    }
  }

  template <class Visit>
  void for_each_near(int i, Visit&& visit) const {
    for (int dx = -1; dx <= 1; ++dx) {
      for (int dy = -1; dy <= 1; ++dy) {
        for (int dz = -1; dz <= 1; ++dz) {
          for (const int j : members_[index(home_[static_cast<std::size_t>(i)] + Eigen::Vector3i(dx, dy, dz))])
            visit(j);
        }
      }
    }
  }

 private:
  std::size_t index(const Eigen::Vector3i& where) const {
    const auto wrapped = [&](int c) { return static_cast<std::size_t>((where[c] + cells_[c]) % cells_[c]); };
    const auto of = [this](int c) { return static_cast<std::size_t>(cells_[c]); };
    return (wrapped(0) * of(1) + wrapped(1)) * of(2) + wrapped(2);
  }

  Eigen::Vector3i cells_;
  std::vector<std::vector<int>> members_;
  std::vector<Eigen::Vector3i> home_;
};

}  // namespace

DoubleDoubleVector displacement_double_double(const Packing& packing, const NeighbourPair& pair) {
  const Pose &a = packing.poses[static_cast<std::size_t>(pair.a)], &b = packing.poses[static_cast<std::size_t>(pair.b)];
  DoubleDoubleVector r;
  for (int c = 0; c < 3; ++c) {
    const DoubleDouble image = short_sum(b.coordinate(c), packing.cell.translation_double_double(c, pair.shift));
    r.set(c, short_sum(image, -a.coordinate(c)));
  }
  return r;
}

std::vector<NeighbourPair> find_neighbours_brute_force(const Packing& packing, double reach) {
  std::vector<NeighbourPair> pairs;
  for (int a = 0; a < packing.size(); ++a) {
    for (int b = a + 1; b < packing.size(); ++b) append_images(packing, a, b, reach, pairs);
  }
  sort_canonically(pairs, 0);
  return pairs;
}

std::vector<NeighbourPair> find_neighbours(const Packing& packing, double reach) {
  Eigen::Vector3i cells;
  for (int c = 0; c < 3; ++c)
    cells[c] = static_cast<int>(std::min(packing.cell.heights()[c] / reach, std::cbrt(packing.size()) + 1));
  if (cells.minCoeff() < 3) return find_neighbours_brute_force(packing, reach);
  const CellGrid grid(packing, cells);
  std::vector<NeighbourPair> pairs;
  for (int a = 0; a < packing.size(); ++a) {
    const std::size_t first = pairs.size();
    grid.for_each_near(a, [&](int b) {
      if (a < b) append_images(packing, a, b, reach, pairs);
    });
    sort_canonically(pairs, first);
  }
  return pairs;
}

}  // namespace isojam
