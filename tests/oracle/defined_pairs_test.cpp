// Reference: 50 digits, checked against rational arithmetic, which decides for faces that differ by 1e-9 rad. The
// environment variable ISOJAM_ORACLE_PAIRS sets the number of pairs, for example to 20000.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <map>
#include <memory>
#include <optional>

#include "tests/engine/geometry/overlap/pair_truth.hpp"
#include "tests/oracle/defined_solids.hpp"

namespace isojam::oracle {
namespace {

using namespace testing_pairs;

constexpr int default_pairs = 300;

int number_of_pairs() {
  const char* text = std::getenv("ISOJAM_ORACLE_PAIRS");
  return text ? std::atoi(text) : default_pairs;
}

/// Largest distance of a corner from the planes of its faces.
double expect_consistent(const ConvexSolid& solid) {
  double worst = 0;
  const RealBody body = body_of(solid);
  for (std::size_t f = 0; f < solid.faces().size(); ++f) {
    const HalfSpace<Real> plane = half_space<Real>(solid, static_cast<int>(f), {}, {});
    const RealVector normal(plane.normal[0], plane.normal[1], plane.normal[2]);
    EXPECT_LE(abs(Real(normal.norm() - 1)), 1e-30) << solid.name();
    for (const int v : solid.faces()[f].vertices) {
      const double distance = static_cast<double>(abs(Real(normal.dot(body.vertices[v]) - plane.offset)));
      EXPECT_LE(distance, 1e-28) << solid.name() << ", face " << f << ", vertex " << v;
      worst = std::max(worst, distance);
    }
  }
  return worst;
}

TEST(DefinedSolids, AreConsistentPolyhedra) {
  double worst = 0;
  for (const SolidKind kind : all_solids) worst = std::max(worst, expect_consistent(platonic(kind)));
  for (const DefinedSolid& defined : defined_solids()) worst = std::max(worst, expect_consistent(*defined.solid));
  std::printf("%zu solids: corners are within %.1e of their planes\n", defined_solids().size(), worst);
}

TEST(DefinedSolids, AreTheSolidsThatWereGiven) {
  std::map<std::string, double> worst;
  for (const DefinedSolid& defined : defined_solids()) {
    const RealBody body = body_of(*defined.solid), given = normalised(defined);
    ASSERT_EQ(body.vertices.size(), given.vertices.size()) << defined.solid->name();
    const Writing& writing = defined.writing;
    const double rounding = std::numeric_limits<double>::epsilon() * std::max(1.0, writing.origin / writing.scale);
    for (std::size_t v = 0; v < body.vertices.size(); ++v) {
      const double moved = static_cast<double>((body.vertices[v] - given.vertices[v]).norm());
      EXPECT_LE(moved, 4 * std::max(64 * rounding, writing.merge) * defined.solid->diameter()) << defined.solid->name();
      double& most = worst[writing.name];
      most = std::max(most, moved);
    }
  }
  for (const auto& [name, moved] : worst) std::printf("%-15s corners move by up to %.1e\n", name.c_str(), moved);
  EXPECT_LE(worst.at("digits_9_split"), 1e-16) << "nothing is merged without being asked for";
}

double exponent(double least, double greatest, RandomStream& random) {
  return std::pow(10.0, least + (greatest - least) * random.uniform());
}

/// A pair in one of the kinds of contacts; nullopt if there is no such contact.
std::optional<PosedPair> contact(int kind, const ConvexSolid& a, const ConvexSolid& b, RandomStream& random) {
  const double depth = exponent(-12, -4, random), volume = exponent(-15, -3, random);
  switch (kind) {
    case 0: return flat_contact(a, b, depth, depth * random.uniform(), random);
    case 1: return flat_contact(a, b, depth, exponent(-10, -2, random), random);
    case 2: return at_volume(corner_over_face(a, b, random), volume);
    case 3: return at_volume(edge_over_edge(a, b, random), volume);
    default: return at_volume(random_approach(a, b, random), volume);
  }
}

constexpr std::array kinds{"face on face", "edge on face", "corner on face", "edge on edge", "any direction"};

template <class T>
ExactOverlap overlap_of(const PosedPair& pair) {
  return exact_overlap<T>({pair.a, pair.at_a}, {pair.b, pair.at_b});
}

struct Survey {
  std::vector<double> volume, area;  ///< relative errors
  int missing = 0;
  int rational = 0;  ///< number of pairs that were compared with rational arithmetic
};

/// Relative error above which the reference itself is checked.
constexpr double coarse = 1e-9;

double greatest(const std::vector<double>& values) { return *std::max_element(values.begin(), values.end()); }

TEST(DefinedPairs, HaveTheOverlapsOfTheReference) {
  RandomStream random{82};
  const auto& solids = defined_solids();
  const auto pick = [&] { return static_cast<std::size_t>(random.uniform() * static_cast<double>(solids.size())); };
  std::array<Survey, kinds.size()> surveys;
  const int pairs = number_of_pairs();
  for (int k = 0; k < pairs; ++k) {
    const ConvexSolid& a = *solids[pick()].solid;
    const auto b = std::make_unique<ConvexSolid>(*solids[pick()].solid, exponent(-1, 0, random));
    const auto kind = static_cast<std::size_t>(k) % kinds.size();
    const auto pair = contact(static_cast<int>(kind), a, *b, random);
    if (!pair) ++surveys[kind].missing;
    if (!pair) continue;
    const ExactOverlap right = overlap_of<Real>(*pair);
    const Overlap got = found(*pair);
    ASSERT_GT(right.volume, 0) << names(a, *b);
    const auto error = [&](const Real& exact) { return static_cast<double>(abs(Real(Real(got.volume) / exact - 1))); };
    double volume = error(right.volume);
    if (volume > coarse) {  // faces that differ by less than the tolerance of the reference
      ++surveys[kind].rational;
      volume = error(overlap_of<Rational>(*pair).volume);
    }
    // One solid is inside the other if the area vector is 0.
    const double area =
        right.area.norm() == 0
            ? 0
            : static_cast<double>(Real((got.area.cast<Real>() - right.area).norm() / right.area.norm()));
    const double smaller = a.volume() < b->volume() ? a.volume() : b->volume();
    const double limit =
        1e-12 + 16 * std::numeric_limits<double>::epsilon() * std::sqrt(smaller / static_cast<double>(right.volume));
    EXPECT_LE(volume, limit) << kinds[kind] << ", " << names(a, *b) << ", V " << static_cast<double>(right.volume);
    EXPECT_LE(area, limit) << kinds[kind] << ", " << names(a, *b) << ", V " << static_cast<double>(right.volume);
    surveys[kind].volume.push_back(volume);
    surveys[kind].area.push_back(area);
    if (k % 50 == 0 && k < default_pairs) {
      EXPECT_LE(abs(Real(overlap_of<Rational>(*pair).volume / right.volume - 1)), 1e-15) << names(a, *b);
    }
  }
  for (std::size_t kind = 0; kind < kinds.size(); ++kind) {
    const Survey& survey = surveys[kind];
    std::printf("%-15s %5zu pairs, %d not made, %d in rational arithmetic: V %.1e, S %.1e at worst\n", kinds[kind],
                survey.volume.size(), survey.missing, survey.rational, greatest(survey.volume), greatest(survey.area));
    EXPECT_GT(static_cast<int>(survey.volume.size()), pairs / 10) << kinds[kind];
    EXPECT_LE(survey.rational, 1 + pairs / 1000) << kinds[kind];
  }
}

}  // namespace
}  // namespace isojam::oracle
