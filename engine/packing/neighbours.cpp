#include "engine/packing/neighbours.hpp"

#include <algorithm>
#include <cmath>

namespace isojam {

namespace {

/// Appends every image of b within reach of a.
void append_images(const Packing& packing, int a, int b, double reach, std::vector<NeighbourPair>& pairs) {
  const double side = packing.cell.side();
  const Eigen::Vector3d d =
      packing.poses[static_cast<std::size_t>(b)].position - packing.poses[static_cast<std::size_t>(a)].position;
  const Eigen::Vector3i nearest = packing.cell.nearest_shift(d);
  const Eigen::Vector3d nearest_d = d + side * nearest.cast<double>();
  // Images farther than the nearest by a whole side matter only while half the side is within reach.
  const int spread = reach > side / 2 ? static_cast<int>(std::floor(reach / side + 0.5)) : 0;
  for (int i = -spread; i <= spread; ++i) {
    for (int j = -spread; j <= spread; ++j) {
      for (int k = -spread; k <= spread; ++k) {
        const Eigen::Vector3i extra(i, j, k);
        if ((nearest_d + side * extra.cast<double>()).squaredNorm() < reach * reach)
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

/// Particles by cell of a grid with `cells` ≥ 3 cells a side.
class CellGrid {
 public:
  CellGrid(const Packing& packing, int cells)
      : cells_(cells), members_(static_cast<std::size_t>(cells) * cells * cells) {
    const double side = packing.cell.side();
    for (int i = 0; i < packing.size(); ++i) {
      Eigen::Vector3i where;
      for (int c = 0; c < 3; ++c) {
        const double u = packing.poses[static_cast<std::size_t>(i)].position[c] / side;
        where[c] = std::min(static_cast<int>((u - std::floor(u)) * cells), cells - 1);
      }
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
    const auto wrapped = [this](int k) { return static_cast<std::size_t>((k + cells_) % cells_); };
    const auto n = static_cast<std::size_t>(cells_);
    return (wrapped(where[0]) * n + wrapped(where[1])) * n + wrapped(where[2]);
  }

  int cells_;
  std::vector<std::vector<int>> members_;
  std::vector<Eigen::Vector3i> home_;
};

}  // namespace

DoubleDoubleVector displacement_double_double(const Packing& packing, const NeighbourPair& pair) {
  const Pose &a = packing.poses[static_cast<std::size_t>(pair.a)], &b = packing.poses[static_cast<std::size_t>(pair.b)];
  DoubleDoubleVector r;
  for (int c = 0; c < 3; ++c) {
    const DoubleDouble image = short_sum(b.coordinate(c), two_product(packing.cell.side(), pair.shift[c]));
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
  const int cells = static_cast<int>(std::min(packing.cell.side() / reach, std::cbrt(packing.size()) + 1));
  if (cells < 3) return find_neighbours_brute_force(packing, reach);
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
