#include "engine/analysis/contacts.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

#include "tests/engine/analysis/constructed_contacts.hpp"

namespace isojam {
namespace {

using constructed::Site;
using Eigen::Vector3d;
using std::numbers::pi;

Alignment angles(double face_face, double edge_face) {
  Alignment alignment;
  alignment.face_face = face_face;
  alignment.edge_face = edge_face;
  return alignment;
}

std::vector<Alignment> random_alignments(int n, RandomStream& random) {
  std::vector<Alignment> all;
  for (int k = 0; k < n; ++k) all.push_back(angles(random.uniform(), random.uniform()));
  return all;
}

TEST(Classes, FollowTheCutoffs) {
  const std::vector<Alignment> all{angles(0.01, 0.01), angles(0.01, 0.9), angles(0.1, 0.01),
                                   angles(0.2, 0.01),  angles(0.2, 0.3),  angles(0.1, 0.3)};
  const std::vector<ContactClass> expected{ContactClass::face_face,   ContactClass::face_face,
                                           ContactClass::edge_face,   ContactClass::edge_face,
                                           ContactClass::lower_order, ContactClass::lower_order};
  EXPECT_EQ(classify(all, 0.1, 0.3), expected);
  const std::vector<ContactClass> none(all.size(), ContactClass::lower_order);
  EXPECT_EQ(classify(all, 0, 0), none);
  EXPECT_EQ(to_string(ContactClass::face_face), "face_face");
  EXPECT_EQ(to_string(ContactClass::edge_face), "edge_face");
  EXPECT_EQ(to_string(ContactClass::lower_order), "lower_order");
}

TEST(Numbers, CountEachContactForTwoParticles) {
  using enum ContactClass;
  const std::vector<ContactClass> classes{face_face, edge_face, edge_face, lower_order, lower_order, lower_order};
  const ContactNumbers numbers = contact_numbers(4, classes);
  EXPECT_EQ(numbers.Z, 3);
  EXPECT_EQ(numbers.Z_ff, 0.5);
  EXPECT_EQ(numbers.Z_ef, 1);
  EXPECT_EQ(numbers.Z_l, 1.5);
  EXPECT_EQ(numbers.C, 3 * 0.5 + 2 * 1 + 1.5);
  const ContactNumbers none = contact_numbers(4, {});
  EXPECT_EQ(none.Z, 0);
  EXPECT_EQ(none.C, 0);
  EXPECT_THROW(contact_numbers(0, classes), std::invalid_argument);
}

TEST(Numbers, AddUpAndGrowWithTheCutoffs) {
  RandomStream random{13};
  for (int trial = 0; trial < 50; ++trial) {
    const int contacts = 1 + static_cast<int>(500 * random.uniform());
    const int particles = 1 + static_cast<int>(200 * random.uniform());
    const std::vector<Alignment> all = random_alignments(contacts, random);
    double constraints = 0;
    for (const double cutoff : {0.0, 0.05, 0.15, 0.25, 0.35, 0.45, 0.55, 1.0}) {
      const ContactNumbers numbers = contact_numbers(particles, classify(all, cutoff, cutoff));
      const double slack = 8 * std::numeric_limits<double>::epsilon() * numbers.C;
      EXPECT_NEAR(numbers.Z * particles, 2 * contacts, slack * particles);
      EXPECT_NEAR(numbers.Z, numbers.Z_ff + numbers.Z_ef + numbers.Z_l, slack);
      EXPECT_NEAR(numbers.C, 3 * numbers.Z_ff + 2 * numbers.Z_ef + numbers.Z_l, slack);
      EXPECT_GE(numbers.C, constraints) << "cut-off " << cutoff;
      constraints = numbers.C;
    }
    EXPECT_NEAR(constraints, 6.0 * contacts / particles, 1e-12 * constraints) << "all face-face: C = 3 Z";
  }
}

class ContactsOf : public testing::TestWithParam<SolidKind> {
 protected:
  const ConvexSolid& solid = platonic(GetParam());
  const CriticalAngles critical = critical_angles(solid);
  RandomStream random{14, static_cast<std::uint64_t>(GetParam())};

  int any(std::size_t size) { return static_cast<int>(random.uniform() * static_cast<double>(size)); }
  Site any_edge() { return constructed::edge_site(solid, any(solid.edges().size())); }
  Site any_face() { return constructed::face_site(solid, any(solid.faces().size())); }
  double spin() { return 2 * pi * random.uniform(); }
  /// An angle of a face-face contact. These angles are spread over decades, and none is near the resolution of the
  /// fits.
  double ultra_low() { return std::pow(10.0, -7 + 3 * random.uniform()); }

  Contact face_on_face() {
    const Site a = any_face();
    const Vector3d axis = a.outward.cross(constructed::random_direction(random)).normalized();
    return constructed::contact(a, any_face(), spin(), ultra_low() * axis, 1e-3);
  }

  /// A contact of an edge in a face. The solid is rotated about the edge through the whole range of θ_ff.
  Contact edge_on_face() {
    const int edge = any(solid.edges().size());
    const Site a = constructed::edge_site(solid, edge);
    const Vector3d along = constructed::direction(solid, edge);
    const Vector3d tilt =
        critical.ff_edge_face * (2 * random.uniform() - 1) * along + ultra_low() * a.outward.cross(along);
    return constructed::contact(a, any_face(), spin(), tilt, 1e-4);
  }

  Contact vertex_on_face() {
    const Site a = constructed::vertex_site(solid, any(solid.vertices().size()));
    const Vector3d axis = a.outward.cross(constructed::random_direction(random)).normalized();
    return constructed::contact(a, any_face(), spin(), critical.ef_vertex_face * random.uniform() * axis, 1e-4);
  }

  Contact edge_on_edge() { return constructed::contact(any_edge(), any_edge(), spin(), Vector3d::Zero(), 1e-4); }

  /// n contacts: one tenth are face-face and two tenths edge-face.
  std::vector<Contact> mixture(int n) {
    std::vector<Contact> contacts;
    for (int k = 0; k < n; ++k) {
      const int kind = k % 10;
      const Contact contact = kind == 0  ? face_on_face()
                              : kind < 3 ? edge_on_face()
                              : kind < 7 ? vertex_on_face()
                                         : edge_on_edge();
      contacts.push_back(constructed::overlapped(solid, contact));
    }
    return contacts;
  }
};

TEST_P(ContactsOf, TopologiesAreRecognised) {
  constexpr int contacts = 1000, particles = 200;
  const std::vector<Contact> mixed = mixture(contacts);
  for (const Contact& contact : mixed) ASSERT_GT(contact.overlap.volume, 0);
  const ContactAnalysis analysis = analyse_contacts(solid, particles, alignments(solid, mixed));
  ASSERT_EQ(analysis.face_face.verdict, FitVerdict::fitted);
  ASSERT_EQ(analysis.edge_face.verdict, FitVerdict::fitted);

  // The error of a fit is the sampling noise of a_0. Face-face contacts also have edges in faces.
  const double ff_noise = 4 * analysis.face_face.a0_error, ef_noise = 4 * analysis.edge_face.a0_error;
  EXPECT_NEAR(analysis.face_face.a[0], 0.1, ff_noise);
  EXPECT_NEAR(analysis.edge_face.a[0], 0.3, ef_noise);
  EXPECT_LT(ff_noise + ef_noise, 0.15) << "else the test says nothing";

  int wrong = 0;
  for (int k = 0; k < contacts; ++k) {
    const ContactClass expected = k % 10 == 0  ? ContactClass::face_face
                                  : k % 10 < 3 ? ContactClass::edge_face
                                               : ContactClass::lower_order;
    wrong += analysis.classes[k] != expected;
  }
  EXPECT_LE(wrong, (ff_noise + ef_noise) * contacts) << "contacts in another class than they were made for";
  const double Z = 2.0 * contacts / particles;
  EXPECT_EQ(analysis.numbers.Z, Z);
  EXPECT_NEAR(analysis.numbers.Z_ff, 0.1 * Z, ff_noise * Z);
  EXPECT_NEAR(analysis.numbers.C, 1.4 * Z, (2 * ff_noise + ef_noise) * Z);
}

TEST_P(ContactsOf, EachAngleIsFittedOnHalfOfItsOwnCriticalAngle) {
  const std::vector<Alignment> all = alignments(solid, mixture(300));
  std::vector<double> face_face, edge_face;
  for (const Alignment& alignment : all) {
    face_face.push_back(alignment.face_face);
    edge_face.push_back(alignment.edge_face);
  }
  const ContactAnalysis analysis = analyse_contacts(solid, 50, all);
  EXPECT_EQ(analysis.face_face.error, fit_cdf(face_face, critical.ff_min() / 2).error);
  EXPECT_EQ(analysis.edge_face.error, fit_cdf(edge_face, critical.ef_min() / 2).error);
}

TEST_P(ContactsOf, OrderDoesNotMatter) {
  const std::vector<Alignment> all = alignments(solid, mixture(300));
  std::vector<Alignment> reversed(all.rbegin(), all.rend());
  ContactAnalysis there = analyse_contacts(solid, 50, all), back = analyse_contacts(solid, 50, reversed);
  std::reverse(back.classes.begin(), back.classes.end());
  EXPECT_EQ(there.classes, back.classes);
  EXPECT_EQ(there.numbers.C, back.numbers.C);
  EXPECT_EQ(there.face_face.cutoff, back.face_face.cutoff);
}

TEST_P(ContactsOf, CollapsedAndEmptyFitsLeaveTheirClassEmpty) {
  // θ_ff is evenly spread, so there is no jump. All θ_ef are above the window, so there are no angles to fit.
  std::vector<Alignment> all;
  for (int k = 0; k < 400; ++k) all.push_back(angles((k + 0.5) / 400 * critical.ff_min(), critical.ef_min()));
  const ContactAnalysis analysis = analyse_contacts(solid, 100, all);
  EXPECT_EQ(analysis.face_face.verdict, FitVerdict::collapsed);
  EXPECT_EQ(analysis.edge_face.verdict, FitVerdict::too_few);
  EXPECT_EQ(analysis.face_face.cutoff, 0);
  EXPECT_EQ(analysis.edge_face.cutoff, 0);
  EXPECT_EQ(analysis.numbers.Z, 8);
  EXPECT_EQ(analysis.numbers.Z_l, 8);
  EXPECT_EQ(analysis.numbers.C, 8);
}

TEST_P(ContactsOf, FixedCutoffsCountMoreConstraints) {
  const std::vector<Alignment> all = alignments(solid, mixture(400));
  const ContactAnalysis analysis = analyse_contacts(solid, 100, all);
  double face_face = 0, constraints = 0;
  for (const double degrees : {5, 15, 25, 35, 45, 55}) {
    for (const Alignment& alignment : all) {
      const bool ff = alignment.face_face < degrees / 180 * pi, ef = alignment.edge_face < degrees / 180 * pi;
      face_face += 2 * ff / 600.0;
      constraints += 2 * (ff ? 3 : ef ? 2 : 1) / 600.0;
    }
  }
  EXPECT_NEAR(analysis.fixed_cutoffs.Z_ff, face_face, 1e-12 * face_face);
  EXPECT_NEAR(analysis.fixed_cutoffs.C, constraints, 1e-12 * constraints);
  EXPECT_NEAR(analysis.fixed_cutoffs.Z, analysis.numbers.Z, 1e-12 * analysis.numbers.Z);
  EXPECT_GT(analysis.fixed_cutoffs.C, 1.3 * analysis.numbers.C);
}

TEST_P(ContactsOf, APoolIsFittedOnceAndClassifiedOneByOne) {
  std::vector<std::vector<Alignment>> packings;
  std::vector<Alignment> together;
  for (const int n : {150, 300, 40, 0}) {
    packings.push_back(alignments(solid, mixture(n)));
    together.insert(together.end(), packings.back().begin(), packings.back().end());
  }
  const std::vector<ContactAnalysis> pooled = analyse_pooled(solid, 50, packings);
  const ContactAnalysis one = analyse_contacts(solid, 50, together);
  EXPECT_EQ(one.pooled_over, 1);
  ASSERT_EQ(pooled.size(), packings.size());
  std::vector<ContactClass> classes;
  for (std::size_t k = 0; k < pooled.size(); ++k) {
    EXPECT_EQ(pooled[k].pooled_over, 4);
    EXPECT_EQ(pooled[k].face_face.cutoff, one.face_face.cutoff);
    EXPECT_EQ(pooled[k].edge_face.cutoff, one.edge_face.cutoff);
    EXPECT_EQ(pooled[k].numbers.Z, 2.0 * static_cast<double>(packings[k].size()) / 50);
    classes.insert(classes.end(), pooled[k].classes.begin(), pooled[k].classes.end());
  }
  EXPECT_EQ(classes, one.classes);
  EXPECT_TRUE(analyse_pooled(solid, 50, {}).empty());
}

TEST(Contacts, OfASolidWithFacesNearlyInOnePlaneHaveNoClasses) {
  RandomStream random{17};
  const std::vector<Alignment> alignments = random_alignments(200, random);
  for (const double height : {1e-4, 1e-8, 1e-12, 3e-13}) {
    std::vector<Vector3d> bent;
    for (int k = 0; k < 8; ++k) bent.emplace_back(k & 1 ? 1 : -1, k & 2 ? 1 : -1, k & 4 ? 1 : -1);
    bent.back().z() += height;
    const ConvexSolid solid("bent", bent);
    EXPECT_EQ(solid.faces().size(), 7U) << height;
    const ContactAnalysis analysis = analyse_contacts(solid, 50, alignments);
    EXPECT_EQ(analysis.face_face.verdict, FitVerdict::too_few) << height;
    EXPECT_EQ(analysis.numbers.Z, 8) << height;
    EXPECT_EQ(analysis.fixed_cutoffs.C, fixed_cutoff_numbers(50, alignments).C) << height;
  }
}

TEST_P(ContactsOf, FewOrPerfectContactsHaveDefinedResults) {
  for (const int contacts : {0, 1}) {
    const ContactAnalysis analysis = analyse_contacts(solid, 3, std::vector<Alignment>(contacts, angles(0, 0)));
    EXPECT_EQ(analysis.face_face.verdict, FitVerdict::too_few);
    EXPECT_EQ(analysis.numbers.C, 2.0 * contacts / 3);
  }
  const ContactAnalysis crystal = analyse_contacts(solid, 10, std::vector<Alignment>(30, angles(0, 0)));
  EXPECT_EQ(crystal.face_face.verdict, FitVerdict::fitted);
  EXPECT_EQ(crystal.numbers.Z_ff, 6);
  EXPECT_EQ(crystal.numbers.C, 18);
}

INSTANTIATE_TEST_SUITE_P(Solids, ContactsOf, testing::ValuesIn(all_solids),
                         [](const auto& solid) { return std::string(to_string(solid.param)); });

}  // namespace
}  // namespace isojam
