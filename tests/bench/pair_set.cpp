#include "tests/bench/pair_set.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <map>
#include <tuple>

#include "engine/random/stream.hpp"

namespace isojam::bench {

namespace {

constexpr int particles = 100;
constexpr std::size_t pairs = 4096;

Eigen::Quaterniond random_orientation(RandomStream& random) {
  const double w = random.normal(), x = random.normal(), y = random.normal(), z = random.normal();
  return Eigen::Quaterniond(w, x, y, z).normalized();
}

int random_particle(RandomStream& random) {
  return std::min(particles - 1, static_cast<int>(particles * random.uniform()));
}

PairSet random_pairs(SolidKind kind, bool touching) {
  const ConvexSolid& solid = platonic(kind);
  RandomStream random{17, static_cast<std::uint64_t>(kind)};
  PairSet set;
  set.placed.resize(solid, particles, false);
  for (std::size_t k = 0; k < set.placed.size(); ++k)
    set.placed.place(k, random_orientation(random).toRotationMatrix());
  while (set.size() < pairs) {
    const Eigen::Vector3d direction = random_orientation(random) * Eigen::Vector3d::UnitX();
    const double distance = 2 * (solid.inradius() + (solid.circumradius() - solid.inradius()) * random.uniform());
    const int a = random_particle(random), b = random_particle(random);
    set.pairs.push_back({a, b, distance * direction});
    const std::size_t k = set.size() - 1;
    SeparatingAxis unused;
    const double volume = overlap(set.a(k), set.b(k), set.r(k), unused).volume;
    if (touching ? volume < 1e-5 || volume > 3e-2 : volume > 0) set.pairs.pop_back();
  }
  std::sort(set.pairs.begin(), set.pairs.end(), [](const PairSet::Pair& p, const PairSet::Pair& q) {
    return std::tie(p.a, p.b, p.r.x()) < std::tie(q.a, q.b, q.r.x());
  });
  return set;
}

const PairSet& kept(SolidKind kind, bool touching) {
  static std::map<std::pair<SolidKind, bool>, PairSet> sets;
  const auto [slot, is_new] = sets.try_emplace({kind, touching});
  if (is_new) slot->second = random_pairs(kind, touching);
  return slot->second;
}

}  // namespace

const PairSet& touching_pairs(SolidKind kind) { return kept(kind, true); }
const PairSet& separated_pairs(SolidKind kind) { return kept(kind, false); }

}  // namespace isojam::bench
