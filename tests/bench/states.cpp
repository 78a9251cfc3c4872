#include "tests/bench/states.hpp"

#include <cmath>
#include <map>
#include <tuple>

#include "engine/solve/minimise/minimise.hpp"

namespace isojam::bench {

namespace {

Packing compressed(SolidKind kind, int n, int number, double density, const MinimiseOptions& options) {
  RandomStream random{29, static_cast<std::uint64_t>(kind), static_cast<std::uint64_t>(n),
                      static_cast<std::uint64_t>(number)};
  Packing packing = random_packing(platonic(kind), n, density, random);
  PackingEnergy energy;
  minimise(packing, energy, options);
  return packing;
}

}  // namespace

const std::vector<Packing>& relaxed(SolidKind kind, int n, int packings) {
  static std::map<std::tuple<SolidKind, int, int>, std::vector<Packing>> known;
  std::vector<Packing>& list = known[{kind, n, packings}];
  MinimiseOptions options;
  options.method = Method::lbfgs;
  options.max_evaluations = 25;
  for (int k = static_cast<int>(list.size()); k < packings; ++k) list.push_back(compressed(kind, n, k, 0.7, options));
  return list;
}

const Packing& equilibrium(SolidKind kind, int n, double density) {
  static std::map<std::tuple<SolidKind, int, double>, Packing> known;
  const auto found = known.find({kind, n, density});
  if (found != known.end()) return found->second;
  Packing packing = compressed(kind, n, 0, 0.78, {});
  PackingEnergy energy;
  const int steps = static_cast<int>(std::ceil((0.78 - density) / 0.01));
  for (int step = 1; step <= steps; ++step) {
    packing = strained_to(packing, 0.78 + (density - 0.78) * step / steps);
    minimise(packing, energy, {});
  }
  return known.emplace(std::tuple(kind, n, density), std::move(packing)).first->second;
}

}  // namespace isojam::bench
