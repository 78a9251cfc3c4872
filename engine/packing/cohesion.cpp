#include "engine/packing/cohesion.hpp"

#include <algorithm>
#include <limits>
#include <stdexcept>
#include <vector>

namespace isojam {

namespace {

/// Relative difference of the distances of two faces below which they count as equal. The faces of a user-defined solid
/// have rounding errors of this size.
constexpr double equal_within = 1e3 * std::numeric_limits<double>::epsilon();

}  // namespace

bool can_grow(const ConvexSolid& solid) {
  const std::vector<double>& offsets = solid.arrays().offset;
  const double greatest = *std::max_element(offsets.begin(), offsets.begin() + solid.arrays().faces);
  return greatest - solid.inradius() <= equal_within * solid.inradius();
}

Composition grown(const Composition& solids, int particles, double distance) {
  std::vector<Particle> list;
  for (std::size_t i = 0; i < static_cast<std::size_t>(particles); ++i) {
    const ConvexSolid& unit = solids.unit(i);
    if (!can_grow(unit))
      throw std::invalid_argument("the faces of " + unit.name() + " have different distances from the centroid");
    list.push_back({&unit, solids[i].scale() + distance / unit.inradius(), solids.kind(i)});
  }
  return Composition(list);
}

}  // namespace isojam
