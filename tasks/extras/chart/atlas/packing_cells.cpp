#include <fmt/format.h>

#include <Eigen/Geometry>
#include <cmath>
#include <stdexcept>

#include "engine/geometry/overlap/clipped_overlap.hpp"
#include "engine/packing/energy.hpp"
#include "tasks/extras/chart/atlas/atlas.hpp"
#include "tasks/extras/chart/atlas/cells.hpp"

namespace isojam {

namespace {

/// Allowed relative error of energies. The contacts are deep, so rounding errors are about 1e-14.
constexpr double tolerance = 1e-12;

/// Number of images in each direction. Even in a cell with 0.4 times the smallest allowed side, no contact involves an
/// image that is farther away.
constexpr int farthest_image = 3;

double pair_energy(const Packing& packing, const Pose& a, const Pose& b, const Eigen::Vector3i& shift) {
  const Eigen::Vector3d r = b.position - a.position + packing.cell.side() * shift.cast<double>();
  if (r.norm() >= 2 * packing.solids.only().circumradius()) return 0;
  const RelativePose pose = relative_pose(a.orientation, b.orientation, r);
  const double volume = clipped_overlap(packing.solids.only(), packing.solids.only(), pose).volume;
  return volume * volume / 4;
}

template <class Visit>
void for_each_image(const Visit& visit) {
  for (int x = -farthest_image; x <= farthest_image; ++x)
    for (int y = -farthest_image; y <= farthest_image; ++y)
      for (int z = -farthest_image; z <= farthest_image; ++z) visit(Eigen::Vector3i(x, y, z));
}

Pose random_pose(RandomStream& random, double spread) {
  Pose pose;
  for (double& x : pose.position) x = spread * (2 * random.uniform() - 1);
  for (double& component : pose.orientation.coeffs()) component = random.normal();
  pose.orientation.normalize();
  return pose;
}

/// The energy of all pairs of particles and images, including pairs of a particle and its own image, by clipping in
/// quadruple precision. It is correct for every cell in the atlas, however small.
double energy_over_images(const Packing& packing) {
  double sum = 0;
  for (std::size_t a = 0; a < packing.poses.size(); ++a) {
    for_each_image([&](const Eigen::Vector3i& shift) {
      if (!shift.isZero()) sum += pair_energy(packing, packing.poses[a], packing.poses[a], shift) / 2;
      for (std::size_t b = a + 1; b < packing.poses.size(); ++b)
        sum += pair_energy(packing, packing.poses[a], packing.poses[b], shift);
    });
  }
  return sum;
}

/// The energy of all pairs of particles, with only the nearest image of each pair.
double energy_of_nearest_images(const Packing& packing) {
  double sum = 0;
  for (std::size_t a = 0; a < packing.poses.size(); ++a) {
    for (std::size_t b = a + 1; b < packing.poses.size(); ++b) {
      const Pose &pa = packing.poses[a], &pb = packing.poses[b];
      sum += pair_energy(packing, pa, pb, packing.cell.nearest_shift(pb.position - pa.position));
    }
  }
  return sum;
}

/// A packing of n tetrahedra at random positions near the corner of a cell. They are so close together that all of them
/// touch, most of them across a face of the cell.
Packing cornered(int n, double side) {
  RandomStream random{7, static_cast<std::uint64_t>(n)};
  Packing packing{platonic(SolidKind::tetrahedron), PeriodicCell(side), {}};
  for (int k = 0; k < n; ++k) {
    Pose pose = random_pose(random, 0.3);
    for (double& x : pose.position) x += x < 0 ? side : 0;
    packing.poses.push_back(pose);
  }
  return packing;
}
AtlasRow energy_row(const std::string& regime, const std::string& setting, const Packing& packing) {
  AtlasRow row{regime, setting, "neighbour list", true, {}, {}, {}};
  try {
    const double energy = PackingEnergy().evaluate(packing).energy, exact = energy_over_images(packing);
    return judged(row, std::abs(energy - exact) / exact, tolerance, "relative error of E");
  } catch (const std::invalid_argument& error) {
    row.figure = fmt::format("L = {:.3f}, least {:.3f}", packing.cell.side(), least_side(packing.solids.only()));
    return refused(row, error.what());
  }
}

}  // namespace

std::vector<AtlasRow> packing_atlas() {
  // The side of the cell is slightly larger than the smallest allowed side, equal to it, or so small that a particle
  // touches two images of another one.
  const double least = least_side(platonic(SolidKind::tetrahedron));
  std::vector<AtlasRow> rows;
  for (int n = 2; n <= 8; ++n) {
    const std::string setting = fmt::format("N = {}", n);
    rows.push_back(energy_row("cell just larger than the least", setting, cornered(n, least * (1 + 1e-12))));
    rows.push_back(energy_row("cell of the least side", setting, cornered(n, least)));
    const Packing small = cornered(n, 0.4 * least);
    rows.push_back(energy_row("cell smaller than the least", setting, small));
    const double exact = energy_over_images(small), nearest = energy_of_nearest_images(small);
    rows.push_back(judged({"cell smaller than the least", setting, "nearest images", false, {}, {}, {}},
                          std::abs(nearest - exact) / exact, tolerance, "relative error of E"));
  }
  return rows;
}

}  // namespace isojam
