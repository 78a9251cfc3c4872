#include "tasks/extras/chart/starts.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "engine/random/stream.hpp"

namespace isojam {

std::vector<JammedSolid> jam_all(const Measuring& measuring) {
  const ChartConfig& config = measuring.config;
  JamOptions options;
  options.minimise.method = Method::newton;
  options.compression.evaluations = 500;  // less than the default, because the compression is not compared here
  options.decompression.final_distance = 0.8 * *std::min_element(config.distances.begin(), config.distances.end());
  std::vector<JammedSolid> all;
  for (const SolidKind solid : config.solids) {
    for (int k = 0; k < config.packings && !measuring.over(); ++k) {
      measuring.progress(fmt::format("jamming {}, N = {}", to_string(solid), config.particles));
      RandomStream random{config.seed, static_cast<std::uint64_t>(solid), static_cast<std::uint64_t>(k)};
      Packing placed = random_packing(platonic(solid), config.particles, options.compression.initial_density, random);
      JamResult result = jam(std::move(placed), options, measuring.stop);
      if (!result.phi_j || result.status == JamStatus::interrupted) continue;
      all.push_back({solid, k, result.phi_j->density, std::move(result.states)});
    }
  }
  return all;
}

std::optional<StrainStart> start_at(const JammedSolid& jammed, double distance) {
  constexpr double least_step = 1.1;  // smallest ratio of the distances; nearer states are too close to the target
  const Packing* above = nullptr;
  for (const Packing& state : jammed.states) {
    if (state.density() - jammed.phi_j >= least_step * distance) above = &state;
  }
  if (above == nullptr) return std::nullopt;
  return StrainStart{*above, above->density() - jammed.phi_j, jammed.phi_j + distance};
}

std::optional<Packing> equilibrium_at(const JammedSolid& jammed, double distance, const Measuring& measuring) {
  const auto start = start_at(jammed, distance);
  if (!start) return std::nullopt;
  Packing packing = start->strained();
  const MinimiseOptions options{.residual = 1e-9};
  PackingEnergy energy;
  if (!is_equilibrium(minimise(packing, energy, options, measuring.stop))) return std::nullopt;
  return packing;
}

std::vector<TaskEquilibria> all_equilibria(std::span<const JammedSolid> jammed, const Measuring& measuring) {
  std::vector<TaskEquilibria> all;
  for (const SolidKind solid : measuring.config.solids) {
    for (const double distance : measuring.config.distances) {
      TaskEquilibria& task = all.emplace_back(TaskEquilibria{task_name(solid, distance), {}});
      for (const JammedSolid& each : jammed) {
        if (each.solid != solid || measuring.over()) continue;
        measuring.progress("equilibria, " + task.task);
        if (auto packing = equilibrium_at(each, distance, measuring)) task.packings.push_back(std::move(*packing));
      }
    }
  }
  return all;
}

BlockMatrix double_double_hessian(const Packing& packing) {
  return PackingEnergy().hessian(packing, Precision::double_double);
}

std::string task_name(SolidKind solid, double distance) {
  return fmt::format("{}, Δφ = {:g}", to_string(solid), distance);
}

}  // namespace isojam
