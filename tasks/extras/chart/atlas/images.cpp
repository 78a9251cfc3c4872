#include "tasks/extras/chart/atlas/images.hpp"

#include <Eigen/Geometry>

#include "engine/geometry/overlap/clipped_overlap.hpp"

namespace isojam {

namespace {

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

}  // namespace

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

Packing cluster(SolidKind kind) {
  RandomStream random{11, static_cast<std::uint64_t>(kind)};
  Packing packing{platonic(kind), PeriodicCell(12), {}};
  for (int k = 0; k < 12; ++k) packing.poses.push_back(random_pose(random, 0.8));
  return packing;
}

}  // namespace isojam
