#include "engine/analysis/contacts.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
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

INSTANTIATE_TEST_SUITE_P(Solids, ContactsOf, testing::ValuesIn(all_solids),
                         [](const auto& solid) { return std::string(to_string(solid.param)); });

}  // namespace
}  // namespace isojam
