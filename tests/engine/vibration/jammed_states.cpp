#include "tests/engine/vibration/jammed_states.hpp"

#include <map>
#include <tuple>

namespace isojam {

const JamResult& jammed(SolidKind kind, int particles, double final_distance, std::uint64_t seed) {
  static std::map<std::tuple<SolidKind, int, double, std::uint64_t>, JamResult> made;
  const auto [place, is_new] = made.try_emplace({kind, particles, final_distance, seed});
  if (is_new) {
    JamOptions options;
    options.compression.initial_density = 0.2;
    options.compression.step = 0.03;
    options.compression.evaluations = 2000;  // the seeds of the tests are chosen for these packings
    options.decompression.final_distance = final_distance;
    options.minimise.residual = 1e-9;
    RandomStream random{seed, static_cast<std::uint64_t>(kind)};
    place->second =
        jam(random_packing(platonic(kind), particles, options.compression.initial_density, random), options);
  }
  return place->second;
}

}  // namespace isojam
