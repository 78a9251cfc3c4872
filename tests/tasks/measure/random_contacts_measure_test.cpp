#include <gtest/gtest.h>

#include <map>

#include "engine/analysis/alignment/random_alignment.hpp"
#include "tasks/measure/measure.hpp"
#include "tests/tasks/support/packings.hpp"

namespace isojam {
namespace {

/// Shares of random contacts whose angles are smaller, as a slow sum over the ends of all contacts.
std::pair<double, double> random_share(const Packing& packing, double face_face, double edge_face) {
  std::map<const ConvexSolid*, RandomAlignment> random;
  std::pair<double, double> sum;
  const auto contacts = PackingEnergy().contacts(packing);
  for (const Contact& contact : contacts) {
    for (const int particle : {contact.pair.a, contact.pair.b}) {
      const ConvexSolid& solid = packing.solids[static_cast<std::size_t>(particle)];
      const RandomAlignment& of_solid = random.try_emplace(&solid, solid).first->second;
      sum.first += of_solid.face_face(face_face);
      sum.second += of_solid.edge_face(edge_face);
    }
  }
  const auto ends = 2 * static_cast<double>(contacts.size());
  return {sum.first / ends, sum.second / ends};
}

Packing packing_of(std::vector<Particle> particles) {
  double volume = 0;
  for (const Particle& each : particles) volume += each.scale * each.scale * each.scale;
  for (Particle& each : particles) each.scale /= std::cbrt(volume / static_cast<double>(particles.size()));
  RandomStream random{20};
  return random_packing(particles, 0.7, random);
}

TEST(RandomContactsMeasure, RangeNearZeroIsThatOfTheSolids) {
  const ConvexSolid &tetrahedron = platonic(SolidKind::tetrahedron), &cube = platonic(SolidKind::cube);
  std::vector<Particle> one, sizes, shapes;
  for (int i = 0; i < 80; ++i) {
    one.push_back({&tetrahedron, 1, 0});
    sizes.push_back({&tetrahedron, i % 2 ? 1.4 : 1, i % 2});
    shapes.push_back({i % 3 ? &tetrahedron : &cube, i % 3 ? 1 : 1.3, i % 3 ? 0 : 1});
  }
  for (const auto& particles : {one, sizes, shapes}) {
    const Packing packing = packing_of(particles);
    const auto angles = measure(Measure::contacts, test::single_state(packing)).states[0].at("contacts").at("angles");
    const auto &face_face = angles.at("face_face_random"), &edge_face = angles.at("edge_face_random");
    const auto [share_ff, share_ef] = random_share(packing, face_face.at("angle"), edge_face.at("angle"));
    EXPECT_NEAR(share_ff, 0.1, 2e-4);
    EXPECT_NEAR(share_ef, 0.1, 2e-4);
    for (const auto* kind : {"face_face", "edge_face"}) {
      const auto& found = angles.at(std::string(kind) + "_random");
      const auto list = angles.at(kind).get<std::vector<double>>();
      EXPECT_EQ(found.at("below").get<long>(), std::count_if(list.begin(), list.end(), [&](double angle) {
                  return angle < found.at("angle").get<double>();
                }));
      EXPECT_NEAR(found.at("expected").get<double>(), 0.1 * static_cast<double>(list.size()), 1e-9);
    }
  }
}

}  // namespace
}  // namespace isojam
