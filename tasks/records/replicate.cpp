#include "tasks/records/replicate.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <utility>

#include "engine/vibration/settle.hpp"
#include "tasks/measure/flag.hpp"

namespace isojam {
namespace {

Checkpoint begin(const ReplicateSpec& spec) {
  if (spec.start) {
    auto packing = initial_packing(*spec.start, spec.replicate);
    if (spec.start->stage == JamStage::as_given) return {begin_as_given(std::move(packing)), {}};
    const bool jammed = spec.start->stage == JamStage::decompression;
    return {
        jammed ? begin_decompression(std::move(packing), spec.options) : begin_jam(std::move(packing), spec.options),
        {}};
  }
  auto random = replicate_stream(spec, Purpose::placement);
  return {
      begin_jam(random_packing(spec.solid.particles(spec.particles), spec.options.compression.initial_density, random),
                spec.options),
      {}};
}

JamResult run_jam(const ReplicateSpec& spec, JamProgress from, std::stop_token stop, const OnProgress& on_progress) {
  JamResult result = jam(std::move(from), spec.options, stop, on_progress);
  const bool at_minima = std::any_of(spec.measures.begin(), spec.measures.end(),
                                     [](Measure what) { return definition_of(what).needs_minima; });
  if (result.status != JamStatus::interrupted && result.status != JamStatus::as_given && at_minima)
    settle(result, spec.options, stop);
  return result;
}

}  // namespace

MeasureOptions measure_options(const ReplicateSpec& spec) {
  auto options = spec.measuring;
  if (ends_at_zero_pressure(spec.options)) options.cohesion = spec.options.cohesion;
  if (spec.start) options.gap = spec.start->gap.value_or(0);
  return options;
}

Stages engine_stages() {
  return {begin, run_jam, [](const ReplicateSpec& spec, Measure what, const JamResult& jam) {
            return measure(what, jam, measure_options(spec));
          }};
}

std::optional<Failure> failure_of(const JamResult& jam) {
  if (jam.status == JamStatus::zero_pressure || jam.status == JamStatus::as_given) return std::nullopt;
  if (jam.status == JamStatus::jammed || jam.status == JamStatus::goal_not_reached) {
    if (jam.phi_j && nearest_state(jam)) return std::nullopt;
    return Failure{"jam", "too few states of positive energy to find the jamming point"};
  }
  auto why = std::string(to_string(jam.status));
  if (!jam.path.empty()) {
    const auto& last = jam.path.back();
    why += fmt::format(" after {} strain steps, at density {:.6f} in {}, E/N {:.3e}, residual {:.3e} ({})",
                       jam.path.size(), last.density, to_string(last.stage), last.energy_per_particle,
                       last.summary.residual, to_string(last.summary.reason));
  }
  if (jam.status == JamStatus::density_limit) why += "; the limit is /protocol/max_density in the manifest: raise it";
  if (jam.status == JamStatus::cell_limit) why += "; more particles leave a cell more room to give way";
  if (jam.status == JamStatus::step_limit) why += "; the limit is /protocol/max_steps in the manifest: raise it";
  return Failure{"jam", why};
}

namespace {

/// True if fewer than two states are in the fit window. Then φ_J was fitted to states outside of it.
bool outside_fit_window(const Outcome& outcome) {
  const auto& jam = outcome.jam;
  if (!jam.phi_j) return false;
  const auto& used = jam.phi_j->states;
  const auto farthest = jam.state_steps[static_cast<std::size_t>(used.back())];
  return used.size() == 2 && jam.path[static_cast<std::size_t>(farthest)].density - jam.phi_j->density >=
                                 outcome.spec.options.decompression.fit_window;
}

}  // namespace

std::vector<Flag> flags_of(const Outcome& outcome) {
  assert(!outcome.failure);
  std::vector<Flag> flags;
  if (outcome.jam.status == JamStatus::goal_not_reached) flags.push_back(Flag::goal_not_reached);
  const auto by_energy = [&](int step) {
    return outcome.jam.path[static_cast<std::size_t>(step)].summary.reason == StopReason::energy_change;
  };
  if (std::any_of(outcome.jam.state_steps.begin(), outcome.jam.state_steps.end(), by_energy))
    flags.push_back(Flag::not_balanced);
  if (outside_fit_window(outcome)) flags.push_back(Flag::outside_fit_window);
  for (const auto& [what, measurement] : outcome.measured) {
    for (const auto& name : measurement.flags) {
      const auto flag = *from_string<Flag>(name);
      if (std::find(flags.begin(), flags.end(), flag) == flags.end()) flags.push_back(flag);
    }
  }
  return flags;
}

}  // namespace isojam
