#include "engine/analysis/exponents.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <numbers>

#include "engine/geometry/solids/solid.hpp"
#include "engine/solve/jam.hpp"
#include "tests/engine/analysis/constructed_contacts.hpp"

namespace isojam {
namespace {

using constructed::Site;
using Eigen::Vector3d;

/// x of a constructed contact between two depths.
double exponent(const ConvexSolid& solid, const Site& a, const Site& b, double spin, const Vector3d& tilt, double from,
                double to) {
  const auto at = [&](double depth) {
    return constructed::overlapped(solid, constructed::contact(a, b, spin, tilt, depth)).overlap;
  };
  return contact_exponent(at(from), at(to), -1e-9);
}

struct Range {
  double least = 1e9, most = -1e9;
  void add(double x) { least = std::min(least, x), most = std::max(most, x); }
};

/// The exact exponents −5, 0 and 1 are those of infinitely small depths. At the depth δ, the sides of a polygon of
/// contact move by about δ, so x differs from them by a multiple of δ divided by the length of an edge.
TEST(ContactExponents, AreThoseOfTheContactClasses) {
  constexpr double depth = 1e-5, allowed = 1000 * depth;
  RandomStream random{31};
  std::map<std::string, Range> seen;
  for (const SolidKind kind : all_solids) {
    const ConvexSolid& solid = platonic(kind);
    const auto any = [&](std::size_t count) { return static_cast<int>(random.uniform() * static_cast<double>(count)); };
    for (int k = 0; k < 20; ++k) {
      const double spin = 2 * std::numbers::pi * random.uniform();
      const Site face = constructed::face_and_edges_site(solid, any(solid.faces().size()));
      const auto edge = [&] { return constructed::edge_site(solid, any(solid.edges().size())); };
      const Site vertex = constructed::vertex_site(solid, any(solid.vertices().size()));
      const auto add = [&](const std::string& name, const Site& a, const Site& b, double turn, const Vector3d& tilt) {
        seen[name].add(exponent(solid, a, b, turn, tilt, depth, .95 * depth));
      };
      const Vector3d none = Vector3d::Zero();
      add("face on face", face, constructed::face_and_edges_site(solid, any(solid.faces().size())), spin, none);
      add("edge in face", face, edge(), spin, none);
      add("vertex in face", face, vertex, spin, .1 * constructed::random_direction(random));
      add("crossed edges", edge(), edge(), std::numbers::pi * (.2 + .6 * random.uniform()), none);
    }
  }
  const std::map<std::string, double> exact{
      {"face on face", -5}, {"edge in face", 0}, {"vertex in face", 1}, {"crossed edges", 1}};
  for (const auto& [name, range] : seen) {
    std::printf("%s: x from %.6f to %.6f\n", name.c_str(), range.least, range.most);
    EXPECT_NEAR(range.least, exact.at(name), allowed) << name;
    EXPECT_NEAR(range.most, exact.at(name), allowed) << name;
  }
}

/// An edge that is tilted out of the face by α touches with a vertex first, and with its whole length if α is much
/// smaller than δ/ℓ. In between, x passes from 1 to 0 without leaving this range.
TEST(ContactExponents, OfATiltedEdgePassFromAVertexToAnEdge) {
  const ConvexSolid& solid = platonic(SolidKind::cube);
  const Site face = constructed::face_site(solid, 0), edge = constructed::edge_site(solid, 0);
  const Vector3d normal = solid.faces()[0].normal;
  const auto& along = solid.edges()[0];
  const double length =
      (solid.vertices()[static_cast<std::size_t>(along.head)] - solid.vertices()[static_cast<std::size_t>(along.tail)])
          .norm();
  constexpr double depth = 1e-6;
  double last = -1;
  for (const double ratio : {.001, .01, .1, .5, .9, 1.1, 1.5, 2., 5., 20., 100.}) {
    // The site is the middle of the edge. The vertex has the depth `depth` if the middle has depth − α ℓ/2.
    const double alpha = ratio * depth / length;
    // About the axis in the face that is perpendicular to the edge, which is found from the largest change of V.
    double x = 0, volume = 0;
    for (int k = 0; k < 180; ++k) {
      const double angle = std::numbers::pi * k / 180;
      const Vector3d axis =
          std::cos(angle) * normal.unitOrthogonal() + std::sin(angle) * normal.cross(normal.unitOrthogonal());
      const double middle = depth - alpha * length / 2;
      const auto at = [&](double change) {
        return constructed::overlapped(solid, constructed::contact(face, edge, 0, alpha * axis, middle - change))
            .overlap;
      };
      const Overlap from = at(0), to = at(.01 * depth);
      if (from.volume <= volume || to.volume <= 0) continue;
      volume = from.volume;
      x = contact_exponent(from, to, -1e-9);
    }
    std::printf("α = %.3f δ/ℓ: x = %.4f\n", ratio, x);
    EXPECT_GE(x, last - 1e-3);
    EXPECT_GE(x, -.01);
    EXPECT_LE(x, 1.01);
    last = x;
  }
  EXPECT_GT(last, .99);
}

TEST(ContactExponents, UseTheMeanForceIfTheirOwnIsConstant) {
  Overlap from, to;
  from.volume = 1, from.area = {2, 0, 0};
  to.volume = 2, to.area = {1, 0, 0};  // the force V|S|/2 is the same
  EXPECT_NEAR(contact_exponent(from, to, -.1), 5 * std::log(1. / 8) / -.1, 1e-9);
  to.volume = .9, to.area = {1.9, 0, 0};
  const double own = std::log(.9 * 1.9 / 2);
  EXPECT_NEAR(contact_exponent(from, to, -.1), 5 * std::log(.95 * .95 / .9) / own, 1e-9);
}

const JamResult& jammed(SolidKind kind) {
  static std::map<SolidKind, JamResult> results;
  if (const auto found = results.find(kind); found != results.end()) return found->second;
  RandomStream random{2024};
  JamOptions options;
  options.decompression.final_distance = 5e-4;
  options.decompression.fit_window = 5e-3;
  return results[kind] = jam(random_packing(platonic(kind), 64, options.compression.initial_density, random), options);
}

TEST(ContactExponents, OfAPackingHardlyDependOnTheLengthOfTheStep) {
  for (const auto kind : {SolidKind::octahedron, SolidKind::dodecahedron}) {
    const Packing& packing = jammed(kind).states.back();
    PackingEnergy energy;
    const auto contacts = energy.contacts(packing);
    const auto here = contact_exponents(packing, contacts, energy);
    ExponentOptions shorter;
    shorter.longest_step = std::abs(here.step) / 4;
    const auto there = contact_exponents(packing, contacts, energy, shorter);
    ASSERT_NE(here.step, 0);
    ASSERT_NE(there.step, 0);
    const auto angles = alignments(packing.solids, contacts);
    const auto classes = classes_of(here, angles);
    std::map<ContactClass, std::vector<double>> of_class;
    std::size_t changed = 0;
    const auto again = classes_of(there, angles);
    for (std::size_t c = 0; c < contacts.size(); ++c) {
      if (here.x[c]) of_class[classes[c]].push_back(*here.x[c]);
      changed += classes[c] != again[c];
    }
    std::printf("%s: %zu contacts, steps %g and %g, %d broken, %zu classes change", to_string(kind).data(),
                contacts.size(), here.step, there.step, here.broken, changed);
    const std::map<ContactClass, double> exact{
        {ContactClass::face_face, -5}, {ContactClass::edge_face, 0}, {ContactClass::lower_order, 1}};
    for (auto& [which, x] : of_class) {
      std::ranges::nth_element(x, x.begin() + static_cast<std::ptrdiff_t>(x.size() / 2));
      std::printf(", median %.4f of %zu", x[x.size() / 2], x.size());
      EXPECT_NEAR(x[x.size() / 2], exact.at(which), .2) << to_string(which);
    }
    std::printf("\n");
    EXPECT_LE(changed, contacts.size() / 40);
  }
}

TEST(ContactExponents, AreUnknownWithoutPressure) {
  RandomStream random{1};
  const Packing loose = random_packing(platonic(SolidKind::cube), 8, .05, random);
  PackingEnergy energy;
  const auto contacts = energy.contacts(loose);
  EXPECT_EQ(contact_exponents(loose, contacts, energy).step, 0);
}

}  // namespace
}  // namespace isojam
