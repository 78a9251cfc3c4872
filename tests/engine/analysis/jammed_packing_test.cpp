#include <gtest/gtest.h>

#include <algorithm>

#include "engine/analysis/alignment/random_alignment.hpp"
#include "engine/analysis/cluster_statistics.hpp"
#include "engine/analysis/order.hpp"
#include "engine/analysis/orientation_order.hpp"
#include "engine/solve/jam.hpp"

namespace isojam {
namespace {

constexpr int particles = 48;

const ConvexSolid& solid() { return platonic(SolidKind::octahedron); }

/// The packing is jammed once in each process.
const JamResult& jammed() {
  static const JamResult result = [] {
    JamOptions options;
    options.compression.initial_density = 0.2;
    options.compression.step = 0.03;
    options.decompression.final_distance = 0.015;
    RandomStream random{81};
    return jam(random_packing(solid(), particles, options.compression.initial_density, random), options);
  }();
  return result;
}

std::vector<Contact> contacts_of(const Packing& packing) {
  PackingEnergy energy;
  return energy.contacts(packing);
}

const Packing& nearest() { return jammed().states.back(); }

std::vector<double> edge_face_angles(const std::vector<Alignment>& alignments) {
  std::vector<double> angles;
  for (const Alignment& alignment : alignments) angles.push_back(alignment.edge_face);
  return angles;
}

TEST(JammedPacking, IsJammed) {
  ASSERT_TRUE(jammed().status == JamStatus::jammed || jammed().status == JamStatus::goal_not_reached)
      << to_string(jammed().status);
  ASSERT_GE(jammed().states.size(), 2U);
}

TEST(JammedPacking, MethodsAgreeWhereTheyShould) {
  const std::vector<Alignment> all = alignments(solid(), contacts_of(nearest()));
  const ContactAnalysis analysis = analyse_contacts(solid(), particles, all);
  std::printf("Z %.2f, Z_ff %.2f by the fit (%s, %.1e rad), C %.2f, %.2f with fixed cut-offs\n", analysis.numbers.Z,
              analysis.numbers.Z_ff, to_string(analysis.face_face.verdict).data(), analysis.face_face.cutoff,
              analysis.numbers.C, analysis.fixed_cutoffs.C);
  ASSERT_EQ(analysis.face_face.verdict, FitVerdict::fitted);
  EXPECT_GT(analysis.fixed_cutoffs.C, 1.3 * analysis.numbers.C);
  EXPECT_NEAR(analysis.numbers.C, 12, 1.5);
}

TEST(JammedPacking, EdgesLieInFacesMoreOftenThanByChance) {
  const RandomAlignment ideal(solid());
  const std::vector<double> angles = edge_face_angles(alignments(solid(), contacts_of(nearest())));
  const Randomness found = compare_with_random(
      angles, [&](double theta) { return ideal.edge_face(theta); }, ideal.ef_max());
  std::printf("%ld of %zu contacts below %.3f rad, %.1f expected, P %.1e\n", found.below, angles.size(), found.angle,
              found.expected, found.probability);
  EXPECT_EQ(found.verdict, RandomnessVerdict::hyper_random);
}

TEST(JammedPacking, ClustersContainItsFaceFaceContacts) {
  const std::vector<Contact> contacts = contacts_of(nearest());
  const ContactAnalysis analysis = analyse_contacts(solid(), particles, alignments(solid(), contacts));
  const std::vector<NeighbourPair> bonds = bonds_of(contacts, analysis.classes);
  const std::vector<Cluster> clusters = find_clusters(nearest(), bonds);
  const std::vector<int> labels = cluster_labels(clusters, particles);
  EXPECT_EQ(std::count(labels.begin(), labels.end(), -1), 0);
  for (const NeighbourPair& bond : bonds) EXPECT_EQ(labels[bond.a], labels[bond.b]);
  EXPECT_DOUBLE_EQ(analysis.numbers.Z_ff, 2.0 * static_cast<double>(bonds.size()) / particles);
  double mean = 0;
  for (int k = 0; k < particles; ++k) {
    mean += static_cast<double>(std::count(labels.begin(), labels.end(), labels[k])) / particles;
    EXPECT_LE(labels[k], k) << "a label is its cluster's smallest particle";
  }
  const ClusterStatistics statistics = cluster_statistics(nearest(), bonds, clusters);
  std::printf("%zu bonds, S %.2f, largest %d, l_max/L %.3f, D %.2f ± %.2f (%s)\n", bonds.size(), statistics.S,
              statistics.largest, statistics.l_max.value_or(-1), statistics.D_max.D, statistics.D_max.error,
              to_string(statistics.D_max.verdict).data());
  EXPECT_NEAR(statistics.S, mean, 1e-12 * mean);
  EXPECT_EQ(statistics.winding_rank, 0);
  // The centres of touching particles are closer than two circumradii.
  const double longest_bond = 2 * solid().circumradius() / nearest().cell.side();
  EXPECT_LE(statistics.l_max.value(), (statistics.largest - 1) * longest_bond);
}

TEST(JammedPacking, IsDisordered) {
  const Order order = order_of(nearest(), contacts_of(nearest()));
  std::printf("Q4 %.3f, Q6 %.3f, local %.3f, %.3f, S_%u %.3f against %.3f by chance\n", order.Q4, order.Q6,
              order.local_Q4.value_or(-1), order.local_Q6.value_or(-1), order.rank, order.S.value_or(-1),
              order.random_S);
  EXPECT_LT(order.Q6, crystalline_q6);
  EXPECT_LT(order.S.value(), 3 * order.random_S);
  EXPECT_GT(order.local_Q6.value(), order.Q6);
}

TEST(PerfectCrystal, OfCubesHasDefinedResults) {
  constexpr int n = 4;
  Packing crystal{platonic(SolidKind::cube), PeriodicCell(0.98 * n), {}};
  for (int k = 0; k < n * n * n; ++k)
    crystal.poses.push_back({.position = 0.98 * Eigen::Vector3i(k % n, k / n % n, k / (n * n)).cast<double>()});
  const std::vector<Contact> contacts = contacts_of(crystal);
  const std::vector<Alignment> all = alignments(crystal.solids.only(), contacts);
  const ContactAnalysis analysis = analyse_contacts(crystal.solids.only(), crystal.size(), all);
  EXPECT_EQ(analysis.face_face.verdict, FitVerdict::fitted);
  EXPECT_EQ(analysis.numbers.Z, 26) << "neighbours across faces, edges and corners";
  EXPECT_EQ(analysis.numbers.Z_ff, 26);
  const std::vector<NeighbourPair> bonds = bonds_of(contacts, analysis.classes);
  const std::vector<Cluster> clusters = find_clusters(crystal, bonds);
  ASSERT_EQ(clusters.size(), 1U);
  const ClusterStatistics statistics = cluster_statistics(crystal, bonds, clusters);
  EXPECT_EQ(statistics.S, n * n * n);
  EXPECT_EQ(statistics.winding_rank, 3);
  EXPECT_TRUE(statistics.spans);
  EXPECT_FALSE(statistics.l_max);
  EXPECT_EQ(statistics.D_max.verdict, DimensionVerdict::winds);
  const Order order = order_of(crystal, contacts);
  EXPECT_NEAR(order.S.value(), 1, 1e-12);
  EXPECT_NEAR(order.local_Q6.value(), order.Q6, 1e-12);
}

}  // namespace
}  // namespace isojam
