#include "tasks/manifest/cost.hpp"

#include <algorithm>
#include <array>

#include "engine/arithmetic/elementary.hpp"

namespace isojam {
namespace {

/// CPU seconds of a replicate with N = 100, compression steps of 0.02 and the default decompression. `compression` is
/// for at most 500 evaluations for a state, `decompression` for Δφ = 0.01. The latter is proportional to Δφ^−power.
/// Fitted to studies of the examples, see tests/tasks/manifest/cost_test.cpp.
struct JamLaw {
  double compression, decompression, power;
};
constexpr std::array<JamLaw, all_solids.size()> jam_laws{{{2.8, 1.5, 0.54},      // tetrahedron
                                                          {1.55, 1.0, 0.6},      // cube
                                                          {1.1, 0.63, 0.57},     // octahedron
                                                          {1.05, 0.58, 0.69},    // dodecahedron
                                                          {0.95, 0.49, 0.66}}};  // icosahedron
/// The values of the parameters for which these times hold.
constexpr double law_distance = 0.01, law_fraction = 0.35, law_step = 0.02, law_evaluations = 500, law_particles = 100;
/// Powers of N, and of the number of evaluations for a state of the compression.
constexpr double compression_size_power = 1.2, decompression_size_power = 1.75, evaluations_power = 0.6;
/// Target energy for which the times hold, its power in the time of a compression, and the smallest such factor.
constexpr double law_energy = 3.2e-5, energy_power = 0.25, smallest_energy_factor = 0.5;
/// Factors of the compression if the target applies before relaxation, and of both stages if the cell shape relaxes.
constexpr double gentle = 0.65, free_cell = 1.2;
/// Factor of a compression with cohesion: the particles attract each other from the beginning, so that each state needs
/// all its evaluations. Cost of a compression in a training cycle, in units of the first compression.
constexpr double cohesive = 6, again = 0.5;

/// Δφ of the first state of a decompression.
constexpr double first_distance = 0.13;

/// The law of a solid. All other solids are estimated like cubes.
const JamLaw& law_of(const Mixture& solid) {
  const auto kind = from_string<SolidKind>(to_string(solid)).value_or(SolidKind::cube);
  return jam_laws[static_cast<std::size_t>(kind)];
}

double steps_to(double distance, double fraction) {
  return nearest::log(std::max(first_distance / distance, 2.0)) / -nearest::log(1 - std::min(fraction, 0.9));
}

double jam_seconds(const ReplicateSpec& spec) {
  const auto& [compression, decompression, power] = law_of(spec.solid);
  const auto& first = spec.options.compression;
  const auto& second = spec.options.decompression;
  const double size = spec.particles / law_particles;
  double up = compression * law_step / first.step * nearest::pow(size, compression_size_power);
  up *= nearest::pow(std::min<double>(first.evaluations, 16 * law_evaluations) / law_evaluations, evaluations_power);
  up *= std::max(smallest_energy_factor, nearest::pow(first.target_energy / law_energy, energy_power));
  if (first.target_before_relaxation) up *= gentle;
  if (spec.options.cohesion.acts()) up *= cohesive;
  if (spec.start && spec.start->stage == JamStage::decompression) up = 0;
  const double down = decompression * nearest::pow(law_distance / second.final_distance, power) *
                      nearest::log(1 - law_fraction) / nearest::log(1 - std::min(second.step_fraction, 0.9)) *
                      nearest::pow(size, decompression_size_power);
  const int cycles = spec.options.cycles;
  return (up * (1 + again * cycles) + down * (1 + cycles)) * (spec.options.cell == CellShape::free ? free_cell : 1);
}

/// CPU seconds of a measure for one state with N = 100, and its power of N. For the shear: of one load step.
struct MeasureLaw {
  Measure what;
  double at_100, power;
};
constexpr std::array measure_laws{
    MeasureLaw{Measure::contacts, 0.01, 1},     MeasureLaw{Measure::order, 0.0027, 1.75},
    MeasureLaw{Measure::clusters, 0.0065, 1.1}, MeasureLaw{Measure::percolation, 0.015, 1.1},
    MeasureLaw{Measure::modes, 0.046, 1.8},     MeasureLaw{Measure::moduli, 0.1, 2.1},
    MeasureLaw{Measure::strict, 0.1, 2.1},      MeasureLaw{Measure::shear, 0.06, decompression_size_power},
    MeasureLaw{Measure::rigidity, 0.025, 2.5},  MeasureLaw{Measure::exponents, 0.03, 2.0},
    MeasureLaw{Measure::backbone, 0.06, 3},     MeasureLaw{Measure::difference_modes, 0.68, 2.3},
    MeasureLaw{Measure::prestress, 0.28, 2.4},  MeasureLaw{Measure::gaps, 0.065, 1.1},
};
static_assert(std::ranges::equal(measure_laws, all_measures, {}, &MeasureLaw::what),
              "a measure has no time in measure_laws, or not at its place in the list of measures");
/// The rank of the constraints takes this many times longer for tetrahedra, which have many states of self-stress.
constexpr double rank_of_tetrahedra = 10;

double measure_seconds(const ReplicateSpec& spec, double states) {
  double seconds = 0;
  for (const auto what : spec.measures) {
    const auto& law = measure_laws[static_cast<std::size_t>(what)];
    double of_measure = law.at_100 * nearest::pow(spec.particles / law_particles, law.power);
    if (what == Measure::rigidity && spec.solid == Mixture(SolidKind::tetrahedron)) of_measure *= rank_of_tetrahedra;
    const auto& shear = spec.measuring.shear;
    seconds += of_measure * (what == Measure::shear ? shear.until / shear.step * (shear.back ? 2 : 1) : states);
  }
  return seconds;
}

/// Number of strain steps of a compression.
constexpr double steps_of_compression = 42;
/// Bytes of a particle in a packing, of a particle, a step and a state in a record, and of the rest of a record.
constexpr double packing_text = 340, particle_text = 600, step_text = 400, state_text = 1500, record_text = 4000;

/// Bytes of memory for each particle, without the factorisation: packings of the decompression (the stages copy them),
/// overlaps and Hessians, and contacts with their forces.
constexpr double particle_bytes = 130e3;
/// Bytes of memory for the factors of the Hessian and their update matrices: factor_bytes N^factor_power. Fill-in grows
/// faster than N.
constexpr double factor_bytes = 800, factor_power = 1.6;

}  // namespace

Cost estimated_cost(const ReplicateSpec& spec, bool keep_path) {
  const double n = spec.particles;
  const double steps_down =
      steps_to(spec.options.decompression.final_distance, spec.options.decompression.step_fraction);
  const double states = ends_at_zero_pressure(spec.options) ? 1 : 1 + steps_down;
  Cost cost;
  cost.cpu_seconds = jam_seconds(spec) + measure_seconds(spec, states);
  cost.memory_bytes = particle_bytes * n + factor_bytes * nearest::pow(n, factor_power);
  const double steps = states + steps_of_compression * law_step / spec.options.compression.step;
  const double packings = keep_path ? 1 + states : 1;
  cost.disk_bytes =
      record_text + step_text * steps + state_text * states + (particle_text + packings * packing_text) * n;
  return cost;
}

int replicates_in_flight(int threads, double largest, double available) {
  // One fifth of the memory remains free, because the estimate can be too small.
  if (largest <= 0) return threads;
  return static_cast<int>(std::clamp(0.8 * available / largest, 1.0, static_cast<double>(threads)));
}

}  // namespace isojam
