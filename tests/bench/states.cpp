#include "tests/bench/states.hpp"

#include <algorithm>
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

const Packing& jammed(SolidKind kind, int n, double distance) {
  static std::map<std::tuple<SolidKind, int, double>, Packing> known;
  const auto found = known.find({kind, n, distance});
  if (found != known.end()) return found->second;
  Packing packing = compressed(kind, n, 0, 0.78, {});
  PackingEnergy energy;
  for (bool last = false; !last;) {
    const Evaluation value = energy.evaluate(packing);
    const double now = 6 * value.energy / n * packing.density() * packing.density() / value.pressure;  // by E ∝ Δφ⁶
    last = now - distance <= 0.3 * now;
    packing = strained_to(packing, packing.density() - (last ? now - distance : 0.3 * now));
    minimise(packing, energy, {});
  }
  return known.emplace(std::tuple(kind, n, distance), std::move(packing)).first->second;
}

}  // namespace isojam::bench
