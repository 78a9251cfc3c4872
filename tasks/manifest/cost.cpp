#include "tasks/manifest/cost.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "engine/arithmetic/elementary.hpp"

namespace isojam {
namespace {

/// CPU seconds of a replicate: at_100 (N/100)^power.
struct CpuLaw {
  double at_100, power;
};
constexpr std::array<CpuLaw, all_solids.size()> cpu_laws{{{11, 2}, {3.5, 2}, {3.5, 2}, {3, 2}, {3.2, 2}}};

/// The law of a solid. All other solids are estimated like cubes; solids that resemble tetrahedra take longer than
/// this.
const CpuLaw& law_of(const Mixture& solid) {
  const auto kind = from_string<SolidKind>(to_string(solid)).value_or(SolidKind::cube);
  return cpu_laws[static_cast<std::size_t>(kind)];
}

/// Share of the compression in the CPU time of a replicate, measured with this strain step.
constexpr double consolidation_share = 0.4, measured_step = 0.02;

/// Number of states of a decompression, and number of all strain steps of a replicate.
constexpr double states = 9, steps_of_path = 50;
/// Bytes of a particle in a packing, of a step and of a state in a record, and of the rest of a record.
constexpr double packing_text = 335, step_text = 400, state_text = 1500, record_text = 4000;

/// Bytes of memory for each particle, without the factorisation: packings of the decompression (the stages copy them),
/// overlaps and Hessians, and contacts with their forces.
constexpr double particle_bytes = 130e3;
/// Bytes of memory for the factors of the Hessian and their update matrices: factor_bytes N^factor_power. Fill-in grows
/// faster than N.
constexpr double factor_bytes = 1.3e3, factor_power = 1.6;

}  // namespace

Cost estimated_cost(const ReplicateSpec& spec, bool keep_path) {
  const auto& law = law_of(spec.solid);
  const double n = spec.particles;
  const double consolidation = consolidation_share * measured_step / spec.options.compression.step;
  Cost cost;
  cost.cpu_seconds = law.at_100 * nearest::pow(n / 100, law.power) * (1 - consolidation_share + consolidation);
  cost.memory_bytes = particle_bytes * n + factor_bytes * nearest::pow(n, factor_power);
  const double packings = keep_path ? 1 + states : 1;
  cost.disk_bytes = record_text + step_text * steps_of_path + state_text * states + packings * packing_text * n;
  return cost;
}

int replicates_in_flight(int threads, double largest, double available) {
  // One fifth of the memory remains free, because the estimate can be too small.
  if (largest <= 0) return threads;
  return static_cast<int>(std::clamp(0.8 * available / largest, 1.0, static_cast<double>(threads)));
}

}  // namespace isojam
