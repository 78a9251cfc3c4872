#include "engine/packing/packing.hpp"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <stdexcept>

#include "engine/packing/cell/control.hpp"
#include "engine/packing/cell/strain.hpp"

namespace isojam {

namespace {

/// Four normals, normalised, are uniform on the unit quaternions and so on SO(3).
Eigen::Quaterniond random_orientation(RandomStream& random) {
  Eigen::Quaterniond q;
  do {
    q.w() = random.normal();
    for (int c = 0; c < 3; ++c) q.vec()[c] = random.normal();
  } while (q.squaredNorm() == 0);
  return q.normalized();
}

/// Place of a position along a Z-order curve through the cell, 2^10 cells a side.
std::uint32_t place_on_curve(const Eigen::Vector3d& position, double side) {
  std::uint32_t place = 0;
  for (int bit = 9; bit >= 0; --bit) {
    for (int c = 0; c < 3; ++c) {
      const auto cell = static_cast<std::uint32_t>(std::min(1023.0, 1024 * position[c] / side));
      place = place << 1 | (cell >> bit & 1);
    }
  }
  return place;
}

}  // namespace

Packing random_packing(const ConvexSolid& solid, int n, double density, RandomStream& random) {
  if (n < 1) throw std::invalid_argument("a packing has at least one particle");
  if (!(density > 0 && density <= 1)) throw std::invalid_argument("a density lies in (0, 1]");
  Packing packing{&solid, PeriodicCell(side_at(n, density)), {}};
  const double side = packing.cell.side();
  if (side <= least_side(solid))
    throw std::invalid_argument("the cell is so small that a particle can touch two images of another");
  packing.poses.resize(static_cast<std::size_t>(n));
  for (Pose& pose : packing.poses) {
    for (int c = 0; c < 3; ++c) pose.position[c] = side * random.uniform();
    pose.orientation = random_orientation(random);
  }
  // Neighbours in space become neighbours in memory, which thousands of particles need for their cost to stay linear.
  std::stable_sort(packing.poses.begin(), packing.poses.end(), [side](const Pose& a, const Pose& b) {
    return place_on_curve(a.position, side) < place_on_curve(b.position, side);
  });
  return packing;
}

Packing strained_to(const Packing& packing, double density) {
  const double side = side_at(packing.size(), density);
  if (!packing.cell.is_cube()) {
    DoubleDoubleMatrix stretch;
    stretch.high *= side / packing.cell.side();
    return deformed(packing, stretch);
  }
  Packing strained = packing;
  strained.cell = PeriodicCell(side);
  const DoubleDoubleMatrix& was = packing.cell.vectors();
  const DoubleDouble stretch = DoubleDouble(side) / was(0, 0);
  for (Pose& pose : strained.poses) pose = scaled(pose, stretch);
  return strained;
}

Packing deformed(const Packing& packing, const DoubleDoubleMatrix& f) {
  Packing result = packing;
  result.cell = packing.cell.deformed(f);
  for (Pose& pose : result.poses) pose = deformed(pose, f);
  return result;
}

namespace {

/// Strained by the entries of a step after those of particles.
Packing strained_by(const Packing& packing, const Eigen::VectorXd& step) {
  const Eigen::Index strains = step.size() - 6 * Eigen::Index{packing.size()};
  const Vector6d strain = strain_basis(freedom_of(strains)) * step.tail(strains) / strain_length(packing.size());
  if (strain.isZero(0)) return packing;
  if (strain.allFinite()) return deformed(packing, exponential(strain_tensor(strain)));
  Packing lost = packing;  // a cell is always finite; what stands in it need not be
  for (Pose& pose : lost.poses) pose.position.setConstant(std::numeric_limits<double>::quiet_NaN());
  return lost;
}

}  // namespace

Packing moved(const Packing& packing, const Eigen::VectorXd& step) {
  Packing result = strained_by(packing, step);
  const double radius = packing.solid->gyration_radius();
  for (int i = 0; i < packing.size(); ++i) {
    // To the bit where it was: what is known of it stays good.
    if (step.segment<6>(6 * i).isZero(0)) continue;
    Pose& pose = result.poses[static_cast<std::size_t>(i)];
    pose = moved(pose, step.segment<3>(6 * i), step.segment<3>(6 * i + 3) / radius);
  }
  return result;
}

}  // namespace isojam
