#include "engine/packing/packing.hpp"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <numeric>
#include <stdexcept>

#include "engine/packing/cell/control.hpp"
#include "engine/packing/cell/strain.hpp"

namespace isojam {

namespace {

/// A vector of four independent normal numbers has a uniform direction. As a unit quaternion it is uniform on SO(3).
Eigen::Quaterniond random_orientation(RandomStream& random) {
  Eigen::Quaterniond q;
  do {
    q.w() = random.normal();
    for (int c = 0; c < 3; ++c) q.vec()[c] = random.normal();
  } while (q.squaredNorm() == 0);
  return q.normalized();
}

/// Index of a position on a Z-order curve through the cell, with 2^10 grid cells per side.
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
  return random_packing(std::vector<Particle>(static_cast<std::size_t>(std::max(n, 0)), Particle{&solid}), density,
                        random);
}

Packing random_packing(std::span<const Particle> particles, double density, RandomStream& random) {
  if (!(density > 0 && density <= 1)) throw std::invalid_argument("a density must be in (0, 1]");
  const std::size_t n = particles.size();
  if (n < 1) throw std::invalid_argument("a packing needs at least one particle");
  const PeriodicCell cell(side_at(static_cast<int>(n), density));
  const double side = cell.side();
  std::vector<Pose> poses(n);
  for (Pose& pose : poses) {
    for (int c = 0; c < 3; ++c) pose.position[c] = side * random.uniform();
    pose.orientation = random_orientation(random);
  }
  // Particles that are neighbours in space become neighbours in memory. Otherwise the cost for thousands of particles
  // would grow faster than linearly.
  std::vector<std::size_t> order(n);
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return place_on_curve(poses[a].position, side) < place_on_curve(poses[b].position, side);
  });
  std::vector<Particle> in_order;
  for (const std::size_t k : order) in_order.push_back(particles[k]);
  Packing packing{Composition(in_order), cell, {}};
  if (!is_legal(cell, packing.solids.widest()))
    throw std::invalid_argument("the cell is so small that a particle can touch two images of another");
  for (const std::size_t k : order) packing.poses.push_back(poses[k]);
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

/// The packing after the strain that the last entries of a step describe.
Packing strained_by(const Packing& packing, const Eigen::VectorXd& step) {
  const Eigen::Index strains = step.size() - 6 * Eigen::Index{packing.size()};
  const Vector6d strain = strain_basis(freedom_of(strains)) * step.tail(strains) / strain_length(packing.size());
  if (strain.isZero(0)) return packing;
  if (strain.allFinite()) return deformed(packing, exponential(strain_tensor(strain)));
  Packing lost = packing;  // PeriodicCell does not accept NaN, but positions do
  for (Pose& pose : lost.poses) pose.position.setConstant(std::numeric_limits<double>::quiet_NaN());
  return lost;
}

}  // namespace

Packing moved(const Packing& packing, const Eigen::VectorXd& step) {
  Packing result = strained_by(packing, step);
  for (int i = 0; i < packing.size(); ++i) {
    // An unmoved particle keeps its bits, so that caches for it stay valid.
    if (step.segment<6>(6 * i).isZero(0)) continue;
    Pose& pose = result.poses[static_cast<std::size_t>(i)];
    pose = moved(pose, step.segment<3>(6 * i), step.segment<3>(6 * i + 3) / packing.solids[i].gyration_radius());
  }
  return result;
}

}  // namespace isojam
