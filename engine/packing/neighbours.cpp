#include "engine/packing/neighbours.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <span>
#include <utility>

#include "engine/arithmetic/elementary.hpp"

namespace isojam {

namespace {

/// Appends the pairs of a with all images of b whose centres are closer to a than `reach`.
void append_images(const Packing& packing, int a, int b, double reach, std::vector<NeighbourPair>& pairs) {
  const Eigen::Vector3d d =
      packing.poses[static_cast<std::size_t>(b)].position - packing.poses[static_cast<std::size_t>(a)].position;
  const Eigen::Vector3i nearest = packing.cell.nearest_shift(d);
  const Eigen::Vector3d nearest_d = d + packing.cell.translation(nearest);
  // The fractional coordinates of the vector to the nearest image are between −½ and ½. Other images matter only if
  // `reach` exceeds half a height of the cell.
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

/// Sorts the pairs from index `first` on by (a, b, shift).
void sort_canonically(std::vector<NeighbourPair>& pairs, std::size_t first) {
  std::sort(pairs.begin() + static_cast<std::ptrdiff_t>(first), pairs.end(),
            [](const auto& p, const auto& q) { return canonical_key(p) < canonical_key(q); });
}

/// A subset of the particles, sorted into a grid. The grid has `cells` ≥ 3 cells along each lattice vector.
class CellGrid {
 public:
  CellGrid(const Packing& packing, std::span<const int> particles, const Eigen::Vector3i& cells)
      : packing_(packing), cells_(cells), members_(static_cast<std::size_t>(cells[0]) * cells[1] * cells[2]) {
    for (const int i : particles) members_[index(home(i))].push_back(i);
  }

  /// Calls visit(j) for all particles j of the grid that are in the cell of particle i or in one of the 26 cells around
  /// it. Particle i may be outside the subset.
  template <class Visit>
  void for_each_near(int i, Visit&& visit) const {
    const Eigen::Vector3i here = home(i);
    for (int dx = -1; dx <= 1; ++dx) {
      for (int dy = -1; dy <= 1; ++dy) {
        for (int dz = -1; dz <= 1; ++dz) {
          for (const int j : members_[index(here + Eigen::Vector3i(dx, dy, dz))]) visit(j);
        }
      }
    }
  }

 private:
  Eigen::Vector3i home(int i) const {
    const Eigen::Vector3d u = packing_.cell.fractional(packing_.poses[static_cast<std::size_t>(i)].position);
    Eigen::Vector3i where;
    for (int c = 0; c < 3; ++c)
      where[c] = std::min(static_cast<int>((u[c] - std::floor(u[c])) * cells_[c]), cells_[c] - 1);
    return where;
  }
  std::size_t index(const Eigen::Vector3i& where) const {
    const auto wrapped = [&](int c) { return static_cast<std::size_t>((where[c] + cells_[c]) % cells_[c]); };
    const auto of = [this](int c) { return static_cast<std::size_t>(cells_[c]); };
    return (wrapped(0) * of(1) + wrapped(1)) * of(2) + wrapped(2);
  }

  const Packing& packing_;
  Eigen::Vector3i cells_;
  std::vector<std::vector<int>> members_;
};

/// Numbers of grid cells along the lattice vectors. Opposite faces of a grid cell have at least the distance `reach`.
/// The numbers are limited so that a grid for few particles is small. Returns nullopt if a number would be below 3.
std::optional<Eigen::Vector3i> grid_cells(const PeriodicCell& cell, double reach, std::size_t particles) {
  Eigen::Vector3i cells;
  for (int c = 0; c < 3; ++c)
    cells[c] = static_cast<int>(std::min(cell.heights()[c] / reach, nearest::cbrt(static_cast<double>(particles)) + 1));
  if (cells.minCoeff() < 3) return std::nullopt;
  return cells;
}

double radius_of(const Packing& packing, int i) { return packing.solids[static_cast<std::size_t>(i)].circumradius(); }

/// A size class: particles with similar circumradii.
class SizeClass {
 public:
  /// `members` must be sorted by circumradius, the largest first.
  SizeClass(const Packing& packing, std::vector<int> members, double skin)
      : members_(std::move(members)),
        radius_(radius_of(packing, members_.front())),
        least_radius_(radius_of(packing, members_.back())) {
    if (const auto cells = grid_cells(packing.cell, 2 * radius_ + skin, members_.size()))
      grid_.emplace(packing, members_, *cells);
  }

  double radius() const { return radius_; }
  bool has(double radius) const { return least_radius_ <= radius && radius <= radius_; }
  /// Visits all particles of this class that may be in reach of particle i. The circumradius of particle i must not be
  /// larger than radius().
  template <class Visit>
  void for_each_near(int i, Visit&& visit) const {
    if (grid_) return grid_->for_each_near(i, visit);
    for (const int j : members_) visit(j);
  }

 private:
  std::vector<int> members_;
  double radius_, least_radius_;
  std::optional<CellGrid> grid_;
};

/// Divides the particles into size classes, the class of the largest particles first.
std::vector<SizeClass> size_classes(const Packing& packing, double skin) {
  std::vector<int> by_size(packing.poses.size());
  std::iota(by_size.begin(), by_size.end(), 0);
  std::stable_sort(by_size.begin(), by_size.end(),
                   [&](int i, int j) { return radius_of(packing, i) > radius_of(packing, j); });
  std::vector<SizeClass> classes;
  for (auto first = by_size.begin(); first != by_size.end();) {
    const double largest = radius_of(packing, *first);
    const auto last = std::find_if(first, by_size.end(), [&](int i) { return 2 * radius_of(packing, i) < largest; });
    classes.emplace_back(packing, std::vector<int>(first, last), skin);
    first = last;
  }
  return classes;
}

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
  const auto cells = grid_cells(packing.cell, reach, packing.poses.size());
  if (!cells) return find_neighbours_brute_force(packing, reach);
  std::vector<int> all(packing.poses.size());
  std::iota(all.begin(), all.end(), 0);
  const CellGrid grid(packing, all, *cells);
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

std::vector<NeighbourPair> find_in_reach(const Packing& packing, double skin) {
  const std::vector<SizeClass> classes = size_classes(packing, skin);
  std::vector<NeighbourPair> pairs;
  for (int i = 0; i < packing.size(); ++i) {
    const double radius = radius_of(packing, i);
    for (const SizeClass& size_class : classes) {
      // Each particle searches only its own class and the classes of larger particles, because their grid cells are
      // large enough.
      if (size_class.radius() < radius) break;
      size_class.for_each_near(i, [&](int j) {
        // In its own class, each of the two particles finds the other one, so one of the two results is dropped.
        if (size_class.has(radius) && j <= i) return;
        const double other = radius_of(packing, j);
        append_images(packing, std::min(i, j), std::max(i, j), radius + other + skin, pairs);
      });
    }
  }
  sort_canonically(pairs, 0);
  return pairs;
}

std::vector<NeighbourPair> find_in_reach_brute_force(const Packing& packing, double skin) {
  std::vector<NeighbourPair> pairs;
  for (int a = 0; a < packing.size(); ++a) {
    for (int b = a + 1; b < packing.size(); ++b)
      append_images(packing, a, b, radius_of(packing, a) + radius_of(packing, b) + skin, pairs);
  }
  sort_canonically(pairs, 0);
  return pairs;
}

}  // namespace isojam
