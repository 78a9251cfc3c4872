#include "engine/analysis/contact_force.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <numbers>

#include "engine/geometry/solids/solid.hpp"
#include "engine/packing/mixture/mixture.hpp"
#include "engine/solve/minimise/minimise.hpp"
#include "tests/engine/analysis/constructed_contacts.hpp"

namespace isojam {
namespace {

using Eigen::Vector3d;

constexpr double epsilon = 2.220446049250313e-16;

Packing sample(SolidKind kind, int n, double density, std::uint64_t seed) {
  RandomStream random{seed};
  return random_packing(platonic(kind), n, density, random);
}

Packing relaxed(Packing packing) {
  PackingEnergy energy;
  MinimiseOptions options;
  options.max_evaluations = 300;
  minimise(packing, energy, options);
  return packing;
}

Packing mixed() {
  RandomStream random{5};
  const Mixture mixture({{SolidKind::cube, .5}, {SolidKind::octahedron, .5, {.from = 1.4}}}, "");
  return random_packing(mixture.particles(80), .7, random);
}

Packing sheared() {
  DoubleDoubleMatrix f;
  f.high(0, 1) = .15, f.high(1, 2) = -.1;
  return deformed(sample(SolidKind::dodecahedron, 90, .65, 6), f);
}

std::vector<Packing> samples() {
  std::vector<Packing> list;
  for (const SolidKind kind : all_solids) list.push_back(relaxed(sample(kind, 64, .7, 1)));
  list.push_back(mixed());
  list.push_back(sheared());
  return list;
}

std::string name_of(const Packing& packing) {
  return packing.solids.unit(0).name() + ", N " + std::to_string(packing.size());
}

TEST(ContactForces, SumUpToTheGradient) {
  for (const Packing& packing : samples()) {
    SCOPED_TRACE(name_of(packing));
    PackingEnergy energy;
    const Evaluation expected = energy.evaluate(packing, Precision::double_double);
    const auto contacts = energy.contacts(packing);
    const auto forces = contact_forces(packing, contacts);
    ASSERT_EQ(static_cast<long>(contacts.size()), expected.contacts);
    Eigen::VectorXd sum = Eigen::VectorXd::Zero(expected.gradient.size()), size = sum;
    double sizes = 0;
    for (std::size_t k = 0; k < forces.size(); ++k) {
      const auto [a, b] = std::pair(contacts[k].pair.a, contacts[k].pair.b);
      const auto radius = [&](int i) { return packing.solids[static_cast<std::size_t>(i)].gyration_radius(); };
      sum.segment<3>(6 * a) -= forces[k].force_a, sum.segment<3>(6 * b) += forces[k].force_a;
      sum.segment<3>(6 * a + 3) -= forces[k].torque_a / radius(a);
      sum.segment<3>(6 * b + 3) -= forces[k].torque_b / radius(b);
      const Overlap& overlap = contacts[k].overlap;
      // Documented limits of the errors in double-double: 1e-15 for contacts with V < 1e-8, and 1e-12 for others.
      EXPECT_NEAR(forces[k].volume, overlap.volume, 1e-12 * overlap.volume) << "contact " << k;
      EXPECT_NEAR(forces[k].area, overlap.area.norm(), 1e-12 * forces[k].area) << "contact " << k;
      sizes += forces[k].force_a.norm();
    }
    const double worst = (sum - expected.gradient).cwiseAbs().maxCoeff(),
                 scale = sizes / static_cast<double>(forces.size());
    RecordProperty(packing.solids.unit(0).name(), std::to_string(worst / scale));
    EXPECT_LT(worst, 1e-11 * scale) << "mean force " << scale;
  }
}

/// Two solids in a large cell. The first one is at the origin and is not rotated.
Packing pair_of(const ConvexSolid& solid, const RelativePose& pose) {
  Packing packing{solid, PeriodicCell(20), std::vector<Pose>(2)};
  packing.poses[1].position = pose.displacement;
  packing.poses[1].orientation = Eigen::Quaterniond(pose.rotation);
  return packing;
}

TEST(ContactForces, OfTwoCubesAgreeWithElementaryGeometry) {
  RelativePose pose;
  pose.displacement = Vector3d(.25, -.5, .96875);  // exact in binary: the overlap is 1/32 deep, and 3/4 by 1/2 wide
  const Packing packing = pair_of(platonic(SolidKind::cube), pose);
  const ContactForce f = contact_force(packing, {0, 1, {0, 0, 0}});
  // S = ∇V, where V is the product of the three widths. The total force on three sides of the box passes through its
  // centre.
  const Vector3d width(.75, .5, 1. / 32),
      gradient(width.y() * width.z(), -width.x() * width.z(), width.x() * width.y());
  const double volume = width.prod(), area = gradient.norm();
  EXPECT_NEAR(f.depth, width.z(), 4 * epsilon);
  EXPECT_NEAR(f.area, area, 4 * epsilon);
  EXPECT_NEAR(f.volume, volume, 4 * epsilon * volume);
  EXPECT_LT((f.normal - gradient / area).norm(), 4 * epsilon) << f.normal.transpose();
  EXPECT_LT((f.force_a + volume / 2 * gradient).norm(), 4 * epsilon * volume);
  EXPECT_LT((f.attack - Vector3d(.125, -.25, .484375)).norm(), 8 * epsilon) << f.attack.transpose();
  EXPECT_EQ(f.kind, ContactKind::face_face);
}

/// The kind of the contact, and its kind if A and B are exchanged.
std::array<ContactKind, 2> kinds_of(const ConvexSolid& solid, const Contact& contact) {
  const Contact other = constructed::exchanged(contact);
  const auto kind = [&](const QuadPose& pose) {
    const QuadIntersection intersection = clipped_intersection(solid, solid, pose);
    return contact_kind(solid, solid, pose, intersection, overlap_of(solid, solid, intersection).area);
  };
  return {kind(widened(contact.pose)), kind(widened(other.pose))};
}

TEST(ContactKinds, AreIdentifiedFromTheIntersection) {
  RandomStream random{9};
  const auto any = [&](std::size_t count) { return static_cast<int>(random.uniform() * static_cast<double>(count)); };
  for (const SolidKind kind : all_solids) {
    const ConvexSolid& solid = platonic(kind);
    for (int k = 0; k < 40; ++k) {
      const auto vertex = constructed::vertex_site(solid, any(solid.vertices().size()));
      const auto face = constructed::face_site(solid, any(solid.faces().size()));
      const auto edge = constructed::edge_site(solid, any(solid.edges().size()));
      const auto other_edge = constructed::edge_site(solid, any(solid.edges().size()));
      const double spin = 2 * std::numbers::pi * random.uniform(), depth = 1e-6 + 1e-5 * random.uniform();
      const Vector3d tilt = .02 * constructed::random_direction(random), none = Vector3d::Zero();
      const auto expect = [&](const Contact& contact, ContactKind expected) {
        for (const ContactKind found : kinds_of(solid, contact))
          EXPECT_EQ(to_string(found), to_string(expected)) << solid.name() << " " << k << " depth " << depth;
      };
      expect(constructed::contact(vertex, face, spin, tilt, depth), ContactKind::vertex_face);
      expect(constructed::contact(face, face, spin, 1e-3 * depth * tilt, depth), ContactKind::face_face);
      // An angle about the normal for which the edges are far from parallel.
      const double cross = std::numbers::pi * (.2 + .6 * random.uniform());
      expect(constructed::contact(edge, other_edge, cross, none, depth), ContactKind::edge_edge);
      expect(constructed::contact(edge, face, spin, 1e-3 * depth * tilt, depth), ContactKind::edge_face);
    }
  }
}

TEST(Contacts, AreAsExactAsTheState) {
  // Two cubes with a depth of 1e-17. Only the low part of the second position contains this depth.
  RelativePose pose;
  pose.displacement = Vector3d(.25, .25, 1);
  Packing packing = pair_of(platonic(SolidKind::cube), pose);
  packing.poses[1].position_low = Vector3d(0, 0, -1e-17);
  const double volume = .75 * .75 * 1e-17;
  PackingEnergy energy;
  EXPECT_TRUE(energy.contacts(packing, Precision::working).empty());
  const auto contacts = energy.contacts(packing);
  ASSERT_EQ(contacts.size(), 1U);
  EXPECT_NEAR(contacts[0].overlap.volume, volume, 1e-9 * volume);
  const ContactForce force = contact_force(packing, contacts[0].pair);
  EXPECT_NEAR(force.volume, volume, 1e-9 * volume);
  EXPECT_NEAR(force.depth, 1e-17, 1e-26);
}

}  // namespace
}  // namespace isojam
