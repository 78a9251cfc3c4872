#pragma once

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstdint>

#include "engine/packing/energy.hpp"
#include "engine/packing/packing.hpp"
#include "engine/random/stream.hpp"

namespace isojam {

/// A number uniformly distributed in [low, high).
inline double uniform(RandomStream& random, double low, double high) { return low + (high - low) * random.uniform(); }

/// A number in [10^low, 10^high) whose logarithm is uniformly distributed.
inline double decade(RandomStream& random, double low, double high) { return std::pow(10, uniform(random, low, high)); }

inline Eigen::VectorXd normal_vector(Eigen::Index size, RandomStream& random) {
  Eigen::VectorXd result(size);
  for (double& entry : result) entry = random.normal();
  return result;
}

/// A random packing with the smallest number of particles that its cell allows, but with at least `least` particles.
inline Packing small_packing(SolidKind kind, double density, std::uint64_t seed, int least = 24) {
  RandomStream random{seed, static_cast<std::uint64_t>(kind)};
  const ConvexSolid& solid = platonic(kind);
  return random_packing(solid, std::max(least, least_particles(solid, density)), density, random);
}

/// A density at which random packings are always jammed. For cubes it is larger, because they can order.
inline double over_compressed(SolidKind kind) { return kind == SolidKind::cube ? 0.85 : 0.75; }

inline bool same_bits(const Packing& p, const Packing& q) {
  return p.solids == q.solids && p.cell.side() == q.cell.side() &&
         std::equal(p.poses.begin(), p.poses.end(), q.poses.begin(), q.poses.end(), [](const Pose& a, const Pose& b) {
           return a.position == b.position && a.orientation.coeffs() == b.orientation.coeffs() &&
                  a.position_low == b.position_low && a.orientation_low == b.orientation_low;
         });
}

inline Eigen::MatrixXd dense(const BlockMatrix& matrix) {
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(6 * matrix.size(), 6 * matrix.size());
  for (int i = 0; i < matrix.size(); ++i) result.block<6, 6>(6 * i, 6 * i) = matrix.diagonal[i];
  for (const BlockMatrix::Block& block : matrix.off_diagonal) {
    result.block<6, 6>(6 * block.row, 6 * block.column) = block.value;
    result.block<6, 6>(6 * block.column, 6 * block.row) = block.value.transpose();
  }
  return result;
}

/// Energy, residual and number of contacts of a packing. They are computed from the definitions, by a sum over
/// contacts.
struct Balance {
  double energy = 0;
  /// largest |F| or |T|/R of a particle, divided by the mean contact force; T is the torque about the centre
  double residual = 0;
  long contacts = 0;
};

inline Balance balance_of(const Packing& packing) {
  PackingEnergy fresh;
  Balance balance;
  Eigen::Matrix3Xd force = Eigen::Matrix3Xd::Zero(3, packing.size()), torque = force;
  double sum_of_forces = 0;
  for (const Contact& contact : fresh.contacts(packing)) {
    const Eigen::Quaterniond& q = packing.poses[static_cast<std::size_t>(contact.pair.a)].orientation;
    const Eigen::Vector3d on_a = q * Eigen::Vector3d(-contact.overlap.volume / 2 * contact.overlap.area);
    const Eigen::Vector3d turn_a = q * Eigen::Vector3d(-contact.overlap.volume / 2 * contact.overlap.moment);
    force.col(contact.pair.a) += on_a;
    force.col(contact.pair.b) -= on_a;
    torque.col(contact.pair.a) += turn_a;
    // The force on B has the same line of action, but the torque is about the centre of B.
    torque.col(contact.pair.b) -= turn_a - contact.displacement.cross(on_a);
    balance.energy += contact.overlap.volume * contact.overlap.volume / 4;
    sum_of_forces += on_a.norm();
    ++balance.contacts;
  }
  if (balance.contacts == 0) return balance;
  const double mean = sum_of_forces / static_cast<double>(balance.contacts);
  for (int i = 0; i < packing.size(); ++i) torque.col(i) /= packing.solids[i].gyration_radius();
  balance.residual = std::max(force.colwise().norm().maxCoeff(), torque.colwise().norm().maxCoeff()) / mean;
  return balance;
}

}  // namespace isojam
