#include "tasks/records/checkpoint.hpp"

#include <fmt/format.h>

#include <cmath>

#include "engine/solve/jamming_point.hpp"
#include "tasks/packings/packing_json.hpp"
#include "tasks/packings/start_packing.hpp"
#include "tasks/records/document.hpp"

namespace isojam {

static void describe(Fields& field, ProcessId& process) {
  field("machine", process.machine, "Boot of the machine and PID namespace.");
  field("process", process.process, "Number of the process.");
  field("started", process.started, "Start of the process, in clock ticks since the boot.");
}

namespace {

bool is_finite(const JamStep& step) {
  const auto& summary = step.summary;
  return std::isfinite(step.density) && std::isfinite(step.energy_per_particle) && std::isfinite(step.pressure) &&
         std::isfinite(step.deviator) && std::isfinite(summary.energy) && !std::isnan(summary.residual) &&
         !std::isnan(summary.residual_floor);
}

/// A packing, which must have the particles of this replicate.
Custom packing_of(Packing& packing, const ReplicateSpec& spec) {
  return {[&packing] { return to_json(packing); },
          [&packing, &spec](const JsonPlace& place) {
            packing = read_packing(place);
            if (packing.size() != spec.particles || !are_particles_of(packing, spec.solid))
              place.refuse("the packing does not belong to this replicate",
                           fmt::format("{} particles of {}", spec.particles, to_string(spec.solid)));
          },
          {{"type", "object"}},
          "a packing"};
}

/// A list of objects that `describe_one` describes.
template <class T, class DescribeOne>
Many list_of(std::vector<T>& list, const DescribeOne& describe_one) {
  return {[&list] { return list.size(); }, [&list](std::size_t size) { list.resize(size); },
          [&list, describe_one](std::size_t k) {
            return MemberRef(Nested{[&one = list[k], describe_one](Fields& field) { describe_one(field, one); }});
          },
          nullptr};
}

/// `any` is a packing that new elements of lists have until they are read.
void describe_result(Fields& field, JamResult& result, const ReplicateSpec& spec, const Packing& any) {
  field("status", result.status, "Reason for the end of the run; `not_called` if it has not ended.");
  field("evaluations", result.evaluations, "Number of evaluations of energy and forces so far.");
  field("pairs", result.counts, "Numbers of pairs so far, as in a record.");
  field("work", result.work, "Numbers of operations so far, as in a record.");
  field.list.push_back({"path", "All strain steps so far.", list_of(result.path, [](Fields& inner, JamStep& step) {
                          Reasoned<> unknown;
                          describe(inner, step, unknown, StepOf::checkpoint);
                        })});
  field("state_steps", result.state_steps, "Index in `path` of the step of each state.");
  const auto state = [&spec](Packing& packing) { return packing_of(packing, spec); };
  field.list.push_back({"states", "Packings of the decompression so far.",
                        Many{[&result] { return result.states.size(); },
                             [&result, &any](std::size_t size) { result.states.resize(size, any); },
                             [&result, state](std::size_t k) { return MemberRef(state(result.states[k])); }, nullptr}});
  field.list.push_back(
      {"cycles", "Training cycles so far.", list_of(result.cycles, [state, &any](Fields& inner, Cycle& cycle) {
         inner("energy_per_particle", cycle.energy_per_particle, "As in a record.");
         inner("phi_j", cycle.phi_j, "As in a record.");
         auto nearest = state(cycle.nearest ? *cycle.nearest : cycle.nearest.emplace(any));
         inner.custom("nearest", std::move(nearest), "Last state of the decompression.");
       })});
}

/// The document of a checkpoint.
struct Document {
  std::string schema;
  std::optional<std::string> checksum;
  Provenance provenance;
  Json spec;
  ProcessId writer;
  Timing timing;
  JamProgress progress;
};

void describe_all(Fields& field, Document& document, const ReplicateSpec& spec) {
  field("schema", document.schema, "Name and version of the file format.");
  field("checksum", document.checksum, "Checksum of the text, as in a record.");
  field("provenance", document.provenance, "The build, the specification and the seed.");
  field.custom("spec",
               {[&document] { return document.spec; },
                [&document](const JsonPlace& place) { document.spec = place.value(); },
                {{"type", "object"}},
                "object"},
               "Settings of the replicate without its measures.");
  field("writer", document.writer, "The process that wrote the checkpoint.");
  field.nested(
      "timing",
      [&timing = document.timing](Fields& inner) {
        inner("wall_seconds", timing.wall_seconds, "Wall-clock time so far.").unit("s").range(not_negative).finite();
        inner("cpu_seconds", timing.cpu_seconds, "CPU time so far.").unit("s").range(not_negative).finite();
      },
      "Time that the replicate has taken.");
  JamProgress& progress = document.progress;
  field("stage", progress.stage, "Stage of the next step.");
  field("step_fraction", progress.step_fraction, "Present step fraction.").range({0, 1, true}).finite();
  field("halvings", progress.halvings, "Number of steps that failed or ended a solution branch.").range({0, 100});
  field("lost", progress.lost, "Index in `path` of the last equilibrium of a branch that has just ended, or −1.")
      .range({-1, count_range.high});
  describe_result(field, progress.result, spec, progress.packing);
  field.custom("packing", packing_of(progress.packing, spec), "Packing from which the next step starts.");
}

/// Measures may be added while a run is interrupted.
Json run_of(const ReplicateSpec& spec) {
  auto json = to_json(spec);
  json.erase("measure");
  return json;
}

void check_indices(const JsonPlace& root, const JamProgress& progress) {
  const auto& [path, steps] = std::pair{progress.result.path.size(), progress.result.state_steps};
  if (path == 0) root.at("path").refuse("the list is empty", "one or more steps");
  const auto is_step = [&count = path](int index) { return static_cast<std::size_t>(index) < count; };
  if (!std::all_of(steps.begin(), steps.end(), is_step)) root.at("state_steps").refuse("a state has no step");
  if (steps.size() != progress.result.states.size()) root.at("state_steps").refuse("not one step for each state");
  if (progress.lost >= 0 && !is_step(progress.lost)) root.at("lost").refuse("no such step");
}

}  // namespace

std::optional<Json> make_checkpoint(const ReplicateSpec& spec, const Checkpoint& checkpoint) {
  const auto& path = checkpoint.progress.result.path;
  if (!std::all_of(path.begin(), path.end(), is_finite)) return std::nullopt;
  Document document{std::string(checkpoint_schema),
                    {},
                    provenance_of(spec),
                    run_of(spec),
                    this_process(),
                    checkpoint.spent,
                    checkpoint.progress};
  Fields fields;
  describe_all(fields, document, spec);
  return written(fields);
}

ProcessId read_writer(const JsonPlace& root) { return read<ProcessId>(root.at("writer")); }

Checkpoint read_checkpoint(const JsonPlace& root, const ReplicateSpec& spec) {
  root.at("schema").choice(std::array{checkpoint_schema});
  if (root.at("provenance").value() != written(provenance_of(spec)))
    root.at("provenance").refuse("the checkpoint belongs to another specification or another build of isojam");
  if (root.at("spec").value() != run_of(spec)) root.at("spec").refuse("the checkpoint belongs to another replicate");
  Document document{"", {}, {}, {}, {}, {}, begin_jam(read_packing(root.at("packing")), spec.options)};
  document.progress.result = {};
  Fields fields;
  describe_all(fields, document, spec);
  read_into(root, fields);
  auto& progress = document.progress;
  check_indices(root, progress);
  auto& result = progress.result;
  if (result.status != JamStatus::not_called)
    result.phi_j = fit_jamming_point(energy_points(result), spec.options.decompression.fit_window);
  return {std::move(progress), document.timing};
}

}  // namespace isojam
