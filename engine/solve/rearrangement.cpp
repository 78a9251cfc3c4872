#include "engine/solve/rearrangement.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cassert>
#include <cmath>
#include <vector>

#include "engine/arithmetic/elementary.hpp"

namespace isojam {

namespace {

/// Keys of the touching pairs, ascending.
auto touching_pairs(const Packing& packing) {
  std::vector<decltype(canonical_key(NeighbourPair{}))> keys;
  for (const Contact& contact : PackingEnergy().contacts(packing)) keys.push_back(canonical_key(contact.pair));
  return keys;
}

/// The deformation F with h₁ = F h₀, where h₀ and h₁ are the matrices of the lattice vectors of two cells.
Eigen::Matrix3d deformation(const PeriodicCell& before, const PeriodicCell& after) {
  if (before.is_cube() && after.is_cube()) return after.side() / before.side() * Eigen::Matrix3d::Identity();
  return after.vectors().high * before.vectors().high.inverse();
}

/// |dx|² + R²|dθ|² of a particle, without the affine strain F.
double squared_displacement(const Pose& before, const Pose& after, const Eigen::Matrix3d& f, double radius) {
  const Eigen::Vector3d dx = after.position - f * before.position;
  const Eigen::Quaterniond rotation = after.orientation * before.orientation.conjugate();
  const double angle = 2 * nearest::atan2(rotation.vec().norm(), std::abs(rotation.w()));
  return dx.squaredNorm() + squared(radius * angle);
}

}  // namespace

double distance_to_jamming(const JamStep& step) {
  return 6 * step.energy_per_particle * step.density * step.density / step.pressure;
}

Rearrangement rearrangement(const Packing& before, const JamStep& step_before, const Packing& after,
                            const JamStep& step_after) {
  assert(before.size() == after.size());
  Rearrangement found;
  const double distance = distance_to_jamming(step_before);
  const double ratio = 1 - (step_before.density - step_after.density) / distance;
  found.energy_ratio = step_after.energy_per_particle / (step_before.energy_per_particle * nearest::pow(ratio, 6));
  const auto old_pairs = touching_pairs(before), new_pairs = touching_pairs(after);
  std::vector<decltype(canonical_key(NeighbourPair{}))> both;
  std::set_intersection(old_pairs.begin(), old_pairs.end(), new_pairs.begin(), new_pairs.end(),
                        std::back_inserter(both));
  found.contacts_lost = static_cast<int>(old_pairs.size() - both.size());
  found.contacts_gained = static_cast<int>(new_pairs.size() - both.size());
  const Eigen::Matrix3d f = deformation(before.cell, after.cell);
  double sum = 0, squares = 0;
  for (std::size_t i = 0; i < after.poses.size(); ++i) {
    const double u2 = squared_displacement(before.poses[i], after.poses[i], f, after.solids[i].gyration_radius());
    sum += u2;
    squares += u2 * u2;
  }
  if (squares > 0) found.particles_moved = sum * sum / squares;
  return found;
}

bool is_rearranged(const JamStep& step) {
  return step.lost || (step.rearrangement && step.rearrangement->energy_ratio < rearranged_below);
}

Rearrangements rearrangements(std::span<const JamStep> path) {
  Rearrangements found;
  double moved = 0, lost = 0, gained = 0;
  int arrived = 0;
  for (const JamStep& step : path) {
    found.steps += step.rearrangement || step.lost;
    found.count += is_rearranged(step);
    if (!is_rearranged(step) || !step.rearrangement) continue;
    ++arrived;
    moved += step.rearrangement->particles_moved;
    lost += step.rearrangement->contacts_lost;
    gained += step.rearrangement->contacts_gained;
  }
  if (arrived > 0) {
    found.particles_moved = moved / arrived;
    found.contacts_lost = lost / arrived;
    found.contacts_gained = gained / arrived;
  }
  return found;
}

}  // namespace isojam
