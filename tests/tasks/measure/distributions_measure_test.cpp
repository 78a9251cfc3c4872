#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <vector>

#include "engine/analysis/contact_force.hpp"
#include "engine/analysis/pair_distribution.hpp"
#include "tasks/measure/measure.hpp"
#include "tasks/measure/shared_parts.hpp"
#include "tests/tasks/support/packings.hpp"

namespace isojam {
namespace {

/// A random packing of octahedra whose kinds are those of `kinds`.
Packing packing_of(const std::vector<int>& kinds, std::uint64_t seed = 7) {
  std::vector<Particle> particles;
  for (const int kind : kinds) particles.push_back({&platonic(SolidKind::octahedron), 1, kind});
  RandomStream random{seed};
  return random_packing(particles, 0.6, random);
}

Json contacts_of(const Packing& packing) {
  const auto state = measure(Measure::contacts, test::single_state(packing)).states.at(0);
  EXPECT_NO_THROW(definition_of(Measure::contacts).state.check({state, "state"}));
  return state.at("contacts");
}

std::vector<int> thirds(int n) {
  std::vector<int> kinds;
  for (int i = 0; i < n; ++i) kinds.push_back(i % 3 == 0 ? 1 : 0);
  return kinds;
}

TEST(DistributionsMeasure, PartialContactNumbersAreCounts) {
  const auto packing = packing_of(thirds(60));
  const auto json = contacts_of(packing);
  double counts[2][2] = {};
  for (const auto& contact : PackingEnergy().contacts(packing)) {
    const int a = packing.solids.kind(static_cast<std::size_t>(contact.pair.a)),
              b = packing.solids.kind(static_cast<std::size_t>(contact.pair.b));
    ++counts[a][b];
    ++counts[b][a];
  }
  const double particles[2] = {40, 20};
  double unlike = 0, total = 0;
  for (int i = 0; i < 2; ++i) {
    double sum = 0;
    for (int j = 0; j < 2; ++j) {
      const double z = json.at("partial").at(fmt::format("Z_{}_{}", i + 1, j + 1)).get<double>();
      EXPECT_NEAR(z, counts[i][j] / particles[i], 1e-12);
      sum += z;
      total += counts[i][j];
      if (i != j) unlike += counts[i][j];
    }
    EXPECT_NEAR(sum, json.at(fmt::format("kind_{}", i + 1)).at("Z").get<double>(), 1e-12);
  }
  const double first = (counts[0][0] + counts[0][1]) / total;
  EXPECT_NEAR(json.at("mixing").get<double>(), unlike / total / (2 * first * (1 - first)), 1e-12);
  EXPECT_FALSE(contacts_of(packing_of(std::vector<int>(60, 0))).contains("partial"));
}

TEST(DistributionsMeasure, MixingDistinguishesRandomAndSeparatedKinds) {
  double mean = 0;
  for (std::uint64_t seed = 0; seed < 8; ++seed)
    mean += contacts_of(packing_of(thirds(90), seed)).at("mixing").get<double>() / 8;
  EXPECT_NEAR(mean, 1, 0.08);
  // The two halves of the cell have different kinds, so that only contacts at their boundaries are unlike.
  auto apart = packing_of(thirds(120));
  std::vector<Particle> halves;
  for (const auto& pose : apart.poses) {
    const double x = pose.position.x() / apart.cell.side();
    halves.push_back({&platonic(SolidKind::octahedron), 1, x - std::floor(x) < 0.5 ? 0 : 1});
  }
  apart.solids = Composition(halves);
  EXPECT_LT(contacts_of(apart).at("mixing").get<double>(), 0.8);
}

TEST(DistributionsMeasure, ForcesAreInUnitsOfTheirMean) {
  const auto packing = packing_of(std::vector<int>(60, 0));
  const auto json = measure(Measure::gaps, test::single_state(packing)).states.at(0).at("gaps");
  std::vector<double> forces;
  for (const auto& force : contact_forces(packing, PackingEnergy().contacts(packing)))
    forces.push_back(force.force_a.norm());
  ASSERT_GT(forces.size(), 100U);
  const auto count = static_cast<double>(forces.size());
  const double mean = std::accumulate(forces.begin(), forces.end(), 0.0) / count;
  const auto edges = json.at("log10_force").get<std::vector<double>>();
  std::vector<long> expected(edges.size() - 1, 0), counted(expected);
  long expected_below = 0, below = 0, weak = 0;
  for (const double force : forces) {
    const auto above = std::upper_bound(edges.begin(), edges.end(), std::log10(force / mean)) - edges.begin();
    ++(above == 0 ? expected_below : expected.at(static_cast<std::size_t>(above - 1)));
    weak += force < mean / 10;
  }
  for (const auto* key : {"face_face", "edge_face", "lower_order"}) {
    const auto counts = json.at(key).at("counts").get<std::vector<long>>();
    for (std::size_t k = 0; k < counts.size(); ++k) counted.at(k) += counts[k];
    below += json.at(key).at("below").get<long>();
  }
  EXPECT_EQ(counted, expected);
  EXPECT_EQ(below, expected_below);
  EXPECT_GT(weak, 0);
  EXPECT_DOUBLE_EQ(json.at("weak_forces").get<double>(), static_cast<double>(weak) / count);
}

TEST(DistributionsMeasure, PairDistributionIsThatOfTheEngine) {
  const auto packing = packing_of(std::vector<int>(60, 0));
  const auto json = measure(Measure::gaps, test::single_state(packing)).states.at(0).at("gaps");
  const auto r = json.at("r").get<std::vector<double>>(), g = json.at("g").get<std::vector<double>>();
  const auto expected = pair_distribution(packing, 0.1, 5);
  ASSERT_EQ(g.size(), expected.size());
  ASSERT_EQ(r.size(), g.size() + 1);
  for (std::size_t k = 0; k < g.size(); ++k) {
    EXPECT_NEAR(r[k], 0.1 * static_cast<double>(k), 1e-12);
    EXPECT_NEAR(g[k], expected[k], 1e-5 * expected[k]);
  }
}

}  // namespace
}  // namespace isojam
