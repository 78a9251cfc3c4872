#include <gtest/gtest.h>

#include <map>

#include "engine/analysis/alignment/random_contact.hpp"
#include "tasks/measure/measure.hpp"

namespace isojam {
namespace {

JamResult result_of(const Packing& packing) {
  const Evaluation here = PackingEnergy().evaluate(packing);
  JamResult result;
  JamStep step;
  step.density = packing.density();
  step.energy_per_particle = here.energy / packing.size();
  result.path = {step};
  result.states = {packing};
  result.state_steps = {0};
  return result;
}

/// Random contacts of two solids, if all their contacts were isotropic; computed with a slow sum.
struct Slow {
  double face_face = 0, edge_face = 0;
};
Slow random_share(const Packing& packing, double face_face, double edge_face) {
  std::map<const ConvexSolid*, RandomAlignment> vertices;
  std::map<std::pair<const ConvexSolid*, const ConvexSolid*>, RandomEdgeContact> edges;
  Slow mean;
  const auto contacts = PackingEnergy().contacts(packing);
  for (const Contact& contact : contacts) {
    const ConvexSolid &a = packing.solids[static_cast<std::size_t>(contact.pair.a)],
                      &b = packing.solids[static_cast<std::size_t>(contact.pair.b)];
    const RandomAlignment &of_a = vertices.try_emplace(&a, a).first->second,
                          &of_b = vertices.try_emplace(&b, b).first->second;
    const RandomEdgeContact& of_edges = edges.try_emplace({&a, &b}, a, b).first->second;
    const ContactSize size_a = contact_size(a), size_b = contact_size(b);
    const double edge_area = size_a.mean_curvature * size_b.mean_curvature / (2 * 3.141592653589793);
    const double sum = size_a.surface + size_b.surface + edge_area;
    const auto all = [&](auto of) {
      return (size_b.surface * of(of_a) + size_a.surface * of(of_b) + edge_area * of(of_edges)) / sum;
    };
    mean.face_face += all([&](const auto& angles) { return angles.face_face(face_face); });
    mean.edge_face += all([&](const auto& angles) { return angles.edge_face(edge_face); });
  }
  const auto n = static_cast<double>(contacts.size());
  return {mean.face_face / n, mean.edge_face / n};
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
    const auto angles = measure(Measure::contacts, result_of(packing)).states[0].at("contacts").at("angles");
    const auto &face_face = angles.at("face_face_random_contact"), &edge_face = angles.at("edge_face_random_contact");
    const auto share = random_share(packing, face_face.at("angle"), edge_face.at("angle"));
    // The points of the numerical integration differ if A and B are exchanged.
    EXPECT_NEAR(share.face_face, 0.1, 2e-4);
    EXPECT_NEAR(share.edge_face, 0.1, 2e-4);
    for (const auto* kind : {"face_face", "edge_face"}) {
      const auto& found = angles.at(std::string(kind) + "_random_contact");
      const auto list = angles.at(kind).get<std::vector<double>>();
      EXPECT_EQ(found.at("below").get<long>(), std::count_if(list.begin(), list.end(), [&](double angle) {
                  return angle < found.at("angle").get<double>();
                }));
      EXPECT_NEAR(found.at("expected").get<double>(), 0.1 * static_cast<double>(list.size()), 1e-9);
      EXPECT_NE(found.at("angle"), angles.at(std::string(kind) + "_random").at("angle"));
    }
  }
}

}  // namespace
}  // namespace isojam
