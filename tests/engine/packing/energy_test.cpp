// Reference: sums over all pairs of particles.

#include "engine/packing/energy.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "engine/geometry/overlap/clipped_overlap.hpp"
#include "tests/engine/packing/packings.hpp"

namespace isojam {
namespace {

using namespace testing_packings;
using Eigen::Matrix3d;
using Eigen::Quaterniond;
using Eigen::Vector3d;
using Eigen::VectorXd;

constexpr int particles = 70;
constexpr double density = .7;

/// Rounding error of one entry of the gradient: the stiffest particle is displaced by a few ulp of the side.
double gradient_tolerance(const Evaluation& evaluation) {
  return 16 * evaluation.residual_floor * evaluation.mean_force;
}

struct Sums {
  double energy = 0, force = 0;
  VectorXd gradient;
  Matrix3d stress = Matrix3d::Zero();
  long contacts = 0;
};

/// Sums over all pairs, computed only from the formulae for one pair.
Sums sums_over_pairs(const Packing& packing) {
  Sums sums;
  sums.gradient = VectorXd::Zero(6 * packing.size());
  const double radius = packing.solids.only().gyration_radius();
  for (const NeighbourPair& pair : find_neighbours_brute_force(packing, 2 * packing.solids.only().circumradius())) {
    const Vector3d r = displacement(packing, pair);
    const Quaterniond &qa = packing.poses[pair.a].orientation, &qb = packing.poses[pair.b].orientation;
    const Overlap o = clipped_overlap(packing.solids.only(), packing.solids.only(), relative_pose(qa, qb, r));
    if (!o.touching()) continue;
    const Vector3d s = qa * o.area, m = qa * o.moment;
    sums.energy += o.volume * o.volume / 4;
    sums.gradient.segment<6>(6 * pair.a) += o.volume / 2 * joined(s, m / radius);
    sums.gradient.segment<6>(6 * pair.b) += o.volume / 2 * joined(-s, (r.cross(s) - m) / radius);
    sums.stress -= o.volume / 2 * s * r.transpose() / packing.cell.volume();
    sums.force += o.volume / 2 * s.norm();
    ++sums.contacts;
  }
  return sums;
}

TEST(PackingEnergyTest, IsTheSumOverAllPairs) {
  for (const Packing& packing : samples(11, particles, density)) {
    const Evaluation got = PackingEnergy().evaluate(packing);
    const Sums sums = sums_over_pairs(packing);
    EXPECT_EQ(got.contacts, sums.contacts) << describe(packing);
    EXPECT_NEAR(got.energy, sums.energy, energy_tolerance(got)) << describe(packing);
    EXPECT_LE((got.gradient - sums.gradient).cwiseAbs().maxCoeff(), gradient_tolerance(got)) << describe(packing);
    EXPECT_LE((got.stress - sums.stress).norm(), 1e-12 * sums.stress.norm()) << describe(packing);
    EXPECT_NEAR(got.pressure, -sums.stress.trace() / 3, 1e-12 * sums.stress.norm()) << describe(packing);
    const double mean_force = sums.force / static_cast<double>(sums.contacts);
    EXPECT_NEAR(got.mean_force, mean_force, 1e-12 * mean_force) << describe(packing);
    double largest = 0;
    for (int k = 0; k < 2 * packing.size(); ++k) largest = std::max(largest, sums.gradient.segment<3>(3 * k).norm());
    EXPECT_NEAR(got.residual, largest / mean_force, 1e-11 * got.residual) << describe(packing);
  }
}

TEST(PackingEnergyTest, WithoutContactsAllIsZero) {
  Packing packing{platonic(SolidKind::octahedron), PeriodicCell(8), std::vector<Pose>(8)};
  for (int i = 0; i < 8; ++i) packing.poses[i].position = Vector3d(4 * (i & 1), 4 * (i >> 1 & 1), 4 * (i >> 2));
  const Evaluation got = PackingEnergy().evaluate(packing);
  EXPECT_EQ(got.contacts, 0);
  EXPECT_EQ(got.energy, 0);
  EXPECT_EQ(got.gradient.norm(), 0);
  EXPECT_EQ(got.residual, 0);
  EXPECT_EQ(got.mean_force, 0);
  EXPECT_EQ(got.pressure, 0);
  EXPECT_TRUE(PackingEnergy().contacts(packing).empty());
}

TEST(PackingEnergyTest, CountsAddUp) {
  RandomStream random{17};
  for (const Packing& packing : samples(17, particles, density)) {
    PackingEnergy energy;
    PairCounts before;
    Packing current = packing;
    for (int k = 1; k <= 5; ++k) {
      const long contacts = energy.evaluate(current).contacts;
      const PairCounts now = energy.counts();
      EXPECT_EQ(energy.evaluations(), k);
      EXPECT_EQ(now.listed, now.out_of_reach + now.by_axis + now.overlapped) << describe(packing);
      EXPECT_EQ(now.touching - before.touching, contacts) << describe(packing);
      EXPECT_GE(now.overlapped - before.overlapped, contacts) << describe(packing);
      // In the first evaluation no separating axis is known. Later, one is known for almost every separated pair within
      // reach.
      if (k == 1) {
        EXPECT_EQ(now.by_axis, 0) << describe(packing);
      } else {
        EXPECT_GT(now.by_axis - before.by_axis, now.overlapped - before.overlapped - contacts) << describe(packing);
      }
      before = now;
      current = moved(current, 1e-3 * random_step(random, packing.size()));
    }
    EXPECT_EQ(before.clipped, 0) << describe(packing);
  }
}

}  // namespace
}  // namespace isojam
