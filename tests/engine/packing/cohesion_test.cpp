// Derivatives are tested in tests/oracle/enthalpy_derivatives_test.cpp.

#include "engine/packing/cohesion.hpp"

#include <gtest/gtest.h>

#include <array>

#include "tests/engine/packing/packings.hpp"

namespace isojam {
namespace {

using namespace testing_packings;

constexpr double h = 0.1, w = 0.02;

Packing two_cubes(double gap) {
  Packing packing{platonic(SolidKind::cube), PeriodicCell(10), {}};
  packing.poses.resize(2);
  packing.poses[0].position = {2, 3, 4};
  packing.poses[1].position = {3 + gap, 3, 4};
  return packing;
}

TEST(Cohesion, IsThatOfTwoParallelCubes) {
  for (const double gap : {0.0, 0.01, 0.05, 0.0999, 0.101, 0.5}) {
    const Evaluation value = PackingEnergy(Cohesion{h, w}).evaluate(two_cubes(gap), Precision::double_double);
    const double expected = gap < h ? -w * (h - gap) * (1 + h) * (1 + h) : 0;
    EXPECT_NEAR(value.energy, expected, 1e-13 * w) << gap;
    const double force = gap < h ? w * (1 + h) * (1 + h) : 0;
    EXPECT_NEAR(value.gradient[0], -force, 1e-13 * w) << gap;
    EXPECT_NEAR(value.gradient[6], force, 1e-13 * w) << gap;
    EXPECT_EQ(value.contacts, 0) << gap;
  }
}

TEST(Cohesion, OfStrengthZeroChangesNothing) {
  for (const Packing& packing : samples(31, 70, .7)) {
    const Evaluation without = PackingEnergy().evaluate(packing),
                     with = PackingEnergy(Cohesion{h, 0}).evaluate(packing);
    EXPECT_EQ(with.energy, without.energy);
    EXPECT_EQ(with.gradient, without.gradient);
    EXPECT_EQ(with.stress, without.stress);
    EXPECT_EQ(with.residual, without.residual);
    EXPECT_FALSE(without.repulsive_pressure);
    EXPECT_EQ(with.repulsive_pressure, with.pressure);
  }
}

TEST(Cohesion, GrowsSolidsWithEquidistantFaces) {
  std::vector<Particle> list;
  for (const SolidKind kind : all_solids) list.push_back({&platonic(kind), 0.9 + 0.1 * static_cast<int>(kind), 0});
  const Composition before(list), after = grown(before, static_cast<int>(list.size()), h / 2);
  for (std::size_t i = 0; i < list.size(); ++i)
    EXPECT_NEAR(after[i].inradius(), before[i].inradius() + h / 2, 1e-15) << before[i].name();
  const std::array<Eigen::Vector3d, 8> corners{
      {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}, {0, 0, 2}, {1, 0, 2}, {0, 1, 2}, {1, 1, 2}}};
  const ConvexSolid brick("brick", corners);
  EXPECT_FALSE(can_grow(brick));
  EXPECT_THROW(grown(brick, 1, h / 2), std::invalid_argument);
}

}  // namespace
}  // namespace isojam
