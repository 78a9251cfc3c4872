#include "tests/bench/pair_set.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <map>
#include <tuple>

#include "engine/packing/neighbours.hpp"
#include "engine/random/stream.hpp"
#include "tests/bench/states.hpp"

namespace isojam::bench {

namespace {

constexpr int particles = 100;
constexpr std::size_t pairs = 4096;
constexpr double least_volume = 1e-5, greatest_volume = 3e-2;
constexpr int packed_particles = 10000;

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
    if (touching ? volume < least_volume || volume > greatest_volume : volume > 0) set.pairs.pop_back();
  }
  std::sort(set.pairs.begin(), set.pairs.end(), [](const PairSet::Pair& p, const PairSet::Pair& q) {
    return std::tie(p.a, p.b, p.r.x()) < std::tie(q.a, q.b, q.r.x());
  });
  return set;
}

PairSet pairs_of(const Packing& packing) {
  const ConvexSolid& solid = packing.solids.only();
  PairSet set;
  set.placed.resize(solid, packing.poses.size(), false);
  for (std::size_t k = 0; k < packing.poses.size(); ++k) set.placed.place(k, rotation_matrix(packing.poses[k]).high);
  for (const NeighbourPair& pair : find_neighbours(packing, 2 * solid.circumradius())) {
    set.pairs.push_back({pair.a, pair.b, displacement(packing, pair)});
    const std::size_t k = set.size() - 1;
    SeparatingAxis unused;
    const double volume = overlap(set.a(k), set.b(k), set.r(k), unused).volume;
    if (volume < least_volume || volume > greatest_volume) set.pairs.pop_back();
  }
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

const PairSet& packing_pairs(SolidKind kind) {
  static std::map<SolidKind, PairSet> sets;
  const auto [slot, is_new] = sets.try_emplace(kind);
  if (is_new) slot->second = pairs_of(relaxed(kind, packed_particles).front());
  return slot->second;
}

const PairSet& separated_pairs(SolidKind kind) { return kept(kind, false); }

}  // namespace isojam::bench
