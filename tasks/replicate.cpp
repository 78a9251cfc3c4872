#include "tasks/replicate.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>

#include "engine/analysis/alignment.hpp"
#include "engine/packing/energy.hpp"

namespace isojam {
namespace {

Packing place(const ReplicateSpec& spec) {
  auto random = replicate_stream(spec, Purpose::placement);
  return random_packing(platonic(spec.solid), spec.particles, spec.options.initial_density, random);
}

JamResult run_jam(const ReplicateSpec& spec, Packing start, std::stop_token stop, const OnStep& on_step) {
  return jam(std::move(start), spec.options, std::move(stop), on_step);
}

std::vector<ContactAnalysis> analyse_states(const ReplicateSpec&, const JamResult& jam) {
  std::vector<ContactAnalysis> analyses;
  PackingEnergy energy;
  for (const auto& state : jam.states) {
    const auto contacts = energy.contacts(state);
    analyses.push_back(analyse_contacts(*state.solid, state.size(), alignments(*state.solid, contacts)));
  }
  return analyses;
}

}  // namespace

Stages engine_stages() { return {place, run_jam, analyse_states}; }

std::optional<Failure> failure_of(const JamResult& jam) {
  if (jam.status == JamStatus::jammed || jam.status == JamStatus::short_of_goal) {
    if (jam.phi_j && !jam.states.empty()) return std::nullopt;
    return Failure{"jam", "too few states of positive energy to find the jamming point"};
  }
  auto why = std::string(to_string(jam.status));
  if (!jam.path.empty()) {
    const auto& last = jam.path.back();
    why += fmt::format(" after {} strain steps, at density {:.6f} in {}, E/N {:.3e}, residual {:.3e} ({})",
                       jam.path.size(), last.density, to_string(last.stage), last.energy_per_particle,
                       last.summary.residual, to_string(last.summary.reason));
  }
  return Failure{"jam", why};
}

std::vector<std::string_view> flags_of(const Outcome& outcome) {
  assert(!outcome.failure);
  std::vector<std::string_view> flags;
  if (outcome.jam.status == JamStatus::short_of_goal) flags.emplace_back("short_of_goal");
  if (!outcome.contacts.empty()) {
    const auto& analysis = outcome.contacts[nearest_state(outcome.jam)];
    const bool decided =
        analysis.face_face.verdict == FitVerdict::fitted && analysis.edge_face.verdict == FitVerdict::fitted;
    if (!decided) flags.emplace_back("classes_undecided");
  }
  return flags;
}

std::size_t nearest_state(const JamResult& jam) {
  assert(!jam.states.empty() && jam.states.size() == jam.state_steps.size());
  std::size_t nearest = jam.states.size();
  for (std::size_t i = 0; i < jam.states.size(); ++i) {
    if (jam.path[jam.state_steps[i]].energy_per_particle <= 0) continue;
    if (nearest == jam.states.size() || jam.states[i].density() < jam.states[nearest].density()) nearest = i;
  }
  assert(nearest < jam.states.size());
  return nearest;
}

}  // namespace isojam
