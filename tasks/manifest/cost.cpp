#include "tasks/manifest/cost.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <limits>
#include <string>

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

/// The number in a file that contains one number. Infinity if the file is missing or contains "max".
double number_in_file(const char* path) {
  std::ifstream file(path);
  double value = 0;
  return file >> value ? value : std::numeric_limits<double>::infinity();
}

double available_of_machine() {
  std::ifstream file("/proc/meminfo");
  std::string key, unit;
  double kibibytes = 0;
  while (file >> key >> kibibytes && std::getline(file, unit)) {
    if (key == "MemAvailable:") return 1024 * kibibytes;
  }
  return std::numeric_limits<double>::infinity();
}

/// Free memory in the control group of this process. Version 2 of control groups is tried first, then version 1.
double available_of_control_group() {
  const double left = number_in_file("/sys/fs/cgroup/memory.max") - number_in_file("/sys/fs/cgroup/memory.current");
  if (std::isfinite(left)) return left;
  return number_in_file("/sys/fs/cgroup/memory/memory.limit_in_bytes") -
         number_in_file("/sys/fs/cgroup/memory/memory.usage_in_bytes");
}

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

double available_memory() {
  const double of_group = available_of_control_group();
  const double least = std::isnan(of_group) ? available_of_machine() : std::min(available_of_machine(), of_group);
  return std::isfinite(least) ? std::max(least, 0.0) : 0;
}

int replicates_in_flight(int threads, double largest, double available) {
  // One fifth of the memory remains free, because the estimate can be too small. If the memory is unknown, it sets no
  // limit.
  if (available <= 0 || largest <= 0) return threads;
  return static_cast<int>(std::clamp(0.8 * available / largest, 1.0, static_cast<double>(threads)));
}

}  // namespace isojam
