#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>

#include "engine/analysis/contacts.hpp"
#include "engine/analysis/orientation_order.hpp"

namespace isojam {
namespace {

using Eigen::Vector3d;

Packing packing_of(const Mixture& mixture, int n, double density, std::uint64_t seed) {
  RandomStream random{seed};
  return random_packing(mixture.particles(n), density, random);
}

Mixture three() {
  return {{{SolidKind::cube, .4}, {SolidKind::octahedron, .4, {.from = 1.2}}, {SolidKind::tetrahedron, .2}}, ""};
}

struct Analysed {
  std::vector<Contact> contacts;
  std::vector<Alignment> angles;
  ContactAnalysis analysis;
};

Analysed analysed(const Packing& packing) {
  Analysed result;
  result.contacts = PackingEnergy().contacts(packing);
  result.angles = alignments(packing.solids, result.contacts);
  result.analysis = analyse_contacts(packing.solids, packing.size(), result.contacts, result.angles);
  return result;
}

TEST(MixtureContacts, AreClassifiedByTheirPairOfShapes) {
  const Packing packing = packing_of(three(), 300, 1, 1);
  const auto [contacts, angles, analysis] = analysed(packing);
  EXPECT_EQ(analysis.pairs.size(), 6U);
  long sum = 0;
  for (const ShapePair& pair : analysis.pairs) {
    sum += pair.contacts;
    std::vector<double> face_face, edge_face;
    std::vector<std::size_t> members;
    for (std::size_t k = 0; k < contacts.size(); ++k) {
      const ConvexSolid *a = &packing.solids.unit(static_cast<std::size_t>(contacts[k].pair.a)),
                        *b = &packing.solids.unit(static_cast<std::size_t>(contacts[k].pair.b));
      if (!((a == pair.a && b == pair.b) || (a == pair.b && b == pair.a))) continue;
      face_face.push_back(angles[k].face_face), edge_face.push_back(angles[k].edge_face), members.push_back(k);
    }
    EXPECT_EQ(static_cast<long>(members.size()), pair.contacts);
    const CriticalAngles critical = critical_angles(*pair.a, *pair.b);
    const double ff = fit_cdf(face_face, critical.ff_min() / 2).cutoff,
                 ef = fit_cdf(edge_face, critical.ef_min() / 2).cutoff;
    EXPECT_EQ(pair.cutoffs.face_face.cutoff, ff);
    EXPECT_EQ(pair.cutoffs.edge_face.cutoff, ef);
    EXPECT_EQ(&analysis.cutoffs_of(*pair.b, *pair.a), &pair.cutoffs);
    for (const std::size_t k : members) {
      const ContactClass expected = angles[k].face_face < ff   ? ContactClass::face_face
                                    : angles[k].edge_face < ef ? ContactClass::edge_face
                                                               : ContactClass::lower_order;
      EXPECT_EQ(analysis.classes[k], expected) << "contact " << k;
    }
  }
  EXPECT_EQ(sum, static_cast<long>(contacts.size()));
}

TEST(MixtureContacts, OfOneShapeAreFittedTogether) {
  const Mixture sizes({{SolidKind::octahedron, .5}, {SolidKind::octahedron, .5, {.from = 1.4}}}, "");
  const Packing packing = packing_of(sizes, 300, 1, 2);
  const auto [contacts, angles, analysis] = analysed(packing);
  const ContactAnalysis together = analyse_contacts(platonic(SolidKind::octahedron), packing.size(), angles);
  EXPECT_TRUE(analysis.pairs.empty());
  EXPECT_EQ(analysis.classes, together.classes);
  EXPECT_EQ(analysis.face_face.cutoff, together.face_face.cutoff);
  EXPECT_TRUE(order_of(packing, contacts).S.has_value());
  const Packing mixed = packing_of(three(), 100, .9, 3);
  EXPECT_FALSE(order_of(mixed, PackingEnergy().contacts(mixed)).S.has_value());
}

TEST(MixtureContacts, OfKindsSumToThoseOfAll) {
  const Packing packing = packing_of(three(), 300, 1, 4);
  const auto [contacts, angles, analysis] = analysed(packing);
  ASSERT_EQ(analysis.of_kinds.size(), 3U);
  const std::vector<int> counts = three().counts(300);
  std::array<int, 3> ends{};
  for (const Contact& contact : contacts) {
    for (const int i : {contact.pair.a, contact.pair.b})
      ++ends[static_cast<std::size_t>(packing.solids.kind(static_cast<std::size_t>(i)))];
  }
  for (std::size_t k = 0; k < 3; ++k)
    EXPECT_NEAR(analysis.of_kinds[k].Z, ends[k] / static_cast<double>(counts[k]), 1e-12) << "kind " << k;
  ContactNumbers mean;
  for (std::size_t k = 0; k < 3; ++k) {
    const double share = counts[k] / 300.0;
    mean.Z += share * analysis.of_kinds[k].Z, mean.C += share * analysis.of_kinds[k].C;
    mean.Z_ff += share * analysis.of_kinds[k].Z_ff, mean.Z_l += share * analysis.of_kinds[k].Z_l;
  }
  EXPECT_NEAR(mean.Z, analysis.numbers.Z, 1e-12);
  EXPECT_NEAR(mean.C, analysis.numbers.C, 1e-12);
  EXPECT_NEAR(mean.Z_ff, analysis.numbers.Z_ff, 1e-12);
  EXPECT_NEAR(mean.Z_l, analysis.numbers.Z_l, 1e-12);
}

TEST(MixtureContacts, HaveTheCriticalAnglesOfTwoShapes) {
  for (const SolidKind kind : all_solids) {
    const ConvexSolid& a = platonic(kind);
    EXPECT_EQ(critical_angles(a, a).ff_edge_edge, critical_angles(a).ff_edge_edge);
    for (const SolidKind other : all_solids) {
      if (other == kind) continue;
      const ConvexSolid& b = platonic(other);
      const CriticalAngles there = critical_angles(a, b), back = critical_angles(b, a);
      EXPECT_EQ(there.ff_edge_edge, back.ff_edge_edge);
      EXPECT_EQ(there.ef_min(), back.ef_min());
      EXPECT_EQ(there.ef_min(), std::min(critical_angles(a).ef_min(), critical_angles(b).ef_min()));
      EXPECT_EQ(there.ff_min(), std::min(critical_angles(a).ff_min(), critical_angles(b).ff_min()));
    }
  }
}

/// A face of a cube on a face of a tetrahedron. Either of them can be A, with both numberings.
TEST(MixtureContacts, AlignTheFeaturesOfEach) {
  const ConvexSolid &cube = platonic(SolidKind::cube), &tetrahedron = platonic(SolidKind::tetrahedron);
  const Vector3d down = -Vector3d::UnitZ();
  Pose on_top;
  on_top.orientation = Eigen::Quaterniond::FromTwoVectors(tetrahedron.faces()[2].normal, down);
  on_top.position = Vector3d(0, 0, .5 + tetrahedron.inradius() - 1e-3);
  for (const bool first : {true, false}) {
    const std::vector<Particle> both{{&cube, 1, 0}, {&tetrahedron, 1, 1}}, reversed{both[1], both[0]};
    const Packing packing{Composition(first ? both : reversed), PeriodicCell(8),
                          first ? std::vector<Pose>{{}, on_top} : std::vector<Pose>{on_top, {}}};
    const auto contacts = PackingEnergy().contacts(packing);
    ASSERT_EQ(contacts.size(), 1U);
    const Alignment found = alignments(packing.solids, contacts).front();
    EXPECT_NEAR(found.face_face, 0, 1e-12);
    EXPECT_EQ(first ? found.face_b : found.face_a, 2);
    const int on_cube = first ? found.face_a : found.face_b;
    EXPECT_NEAR(cube.faces()[static_cast<std::size_t>(on_cube)].normal.z(), 1, 1e-12);
  }
}

}  // namespace
}  // namespace isojam
