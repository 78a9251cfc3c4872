#include "engine/analysis/cohesive_contacts.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "engine/random/stream.hpp"

namespace isojam {
namespace {

/// Two parallel unit cubes in a large cell, with the distance 1 − depth along x.
Packing cubes(double depth) {
  Packing packing{platonic(SolidKind::cube), PeriodicCell(8), {}};
  packing.poses.resize(2);
  packing.poses[0].position = {1, 1, 1};
  packing.poses[1].position = {2 - depth, 1, 1};
  return packing;
}

CohesiveContacts contacts_of(const Packing& packing, const Cohesion& cohesion) {
  return cohesive_contacts(packing, PackingEnergy().contacts(packing), cohesion);
}

TEST(CohesiveContacts, OfParallelCubes) {
  const Cohesion cohesion{0.1, 1e-3};
  const double balance = 2 * cohesion.strength * 1.1 * 1.1;  // depth at which attraction and repulsion are equal
  for (const double factor : {0.5, 0.9, 1.1, 2.0}) {
    const CohesiveContacts found = contacts_of(cubes(factor * balance), cohesion);
    EXPECT_EQ(found.grown, 1) << factor;
    ASSERT_EQ(found.tension.size(), 1U) << factor;
    EXPECT_EQ(found.tension[0], factor < 1) << factor;
  }
  EXPECT_EQ(contacts_of(cubes(-0.09), cohesion).grown, 1);
  EXPECT_TRUE(contacts_of(cubes(-0.09), cohesion).tension.empty());
  EXPECT_EQ(contacts_of(cubes(-0.11), cohesion).grown, 0);
}

/// Energy of the packing after its second particle has moved by `step`.
double energy_after(Packing packing, const Eigen::Vector3d& step, const Cohesion& cohesion) {
  packing.poses[1].position += step;
  return PackingEnergy(cohesion).evaluate(packing, Precision::double_double).energy;
}

TEST(CohesiveContacts, AgreeWithDifferencesOfTheEnergy) {
  const Cohesion cohesion{0.1, 0.02};
  int pulled = 0, pushed = 0;
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    RandomStream random{seed};
    Packing packing = cubes(0.3 * random.uniform());
    packing.solids = platonic(SolidKind::octahedron);
    for (Pose& pose : packing.poses) {
      const Eigen::Quaterniond turn(random.normal(), random.normal(), random.normal(), random.normal());
      pose.orientation = turn.normalized();
    }
    const std::vector<Contact> contacts = PackingEnergy().contacts(packing);
    if (contacts.empty()) continue;
    // The direction out of a, in which the repulsion pushes b.
    const Eigen::Vector3d normal = (packing.poses[0].orientation * contacts[0].overlap.area).normalized();
    const double step = 1e-4 * std::cbrt(contacts[0].overlap.volume);
    const double slope =
        energy_after(packing, step * normal, cohesion) - energy_after(packing, -step * normal, cohesion);
    const bool tension = slope > 0;
    (tension ? pulled : pushed)++;
    EXPECT_EQ(contacts_of(packing, cohesion).tension.at(0), tension) << "seed " << seed;
  }
  std::printf("%d contacts under tension, %d under pressure\n", pulled, pushed);
  EXPECT_GT(pulled, 4);
  EXPECT_GT(pushed, 4);
}

}  // namespace
}  // namespace isojam
