#include "tasks/run/additions.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <utility>

#include "engine/vibration/settle.hpp"
#include "tasks/io/input_error.hpp"
#include "tasks/io/place.hpp"
#include "tasks/io/sealed.hpp"
#include "tasks/measure/recorded_measurement.hpp"
#include "tasks/packings/packing_json.hpp"
#include "tasks/records/restored.hpp"
#include "tasks/records/texts.hpp"

namespace isojam {
namespace fs = std::filesystem;
namespace {

std::string file_of(const fs::path& directory, const char* folder, const std::string& name) {
  return (directory / folder / (name + ".json")).string();
}

bool needs_minima(const std::vector<Measure>& measures) {
  return std::any_of(measures.begin(), measures.end(), [](Measure what) { return definition_of(what).needs_minima; });
}

bool has(const std::vector<Measure>& measures, Measure what) {
  return std::find(measures.begin(), measures.end(), what) != measures.end();
}

/// True if the replicate failed before the first measure.
bool failed_before_measures(const RecordedReplicate& held) {
  return !from_string<Measure>(held.document.failure->where);
}

bool has_path(const fs::path& directory, const RecordedReplicate& held) {
  return fs::exists(file_of(directory, "paths", held.name));
}

/// Reason why no state of a successful replicate can be measured; nullopt if its path, or at least its packing, can be
/// read.
std::optional<std::string> without_states(const fs::path& directory, const RecordedReplicate& held) {
  try {
    check_companions(directory, held, has_path(directory, held));
    return std::nullopt;
  } catch (const InputError& error) {
    return problem_line(error.details());
  }
}

/// All states of a replicate whose path was not kept. Only the nearest state has particles.
std::vector<Packing> nearest_packing_of(const fs::path& directory, const RecordedReplicate& held) {
  const auto json = read_state_file_of(directory, held, "packings");
  auto nearest = read_packing({json, file_of(directory, "packings", held.name)});
  std::vector<Packing> packings(held.document.states.size(), Packing{nearest.solids, nearest.cell, {}});
  packings.at(static_cast<std::size_t>(*held.document.nearest.value)) = std::move(nearest);
  return packings;
}

std::vector<Packing> packings_of(const fs::path& directory, const RecordedReplicate& held) {
  if (!has_path(directory, held)) return nearest_packing_of(directory, held);
  const auto json = read_state_file_of(directory, held, "paths");
  const auto states = JsonPlace(json, file_of(directory, "paths", held.name)).at("states");
  std::vector<Packing> packings;
  const auto count = states.expect_list(list_of_states);
  for (std::size_t k = 0; k < count; ++k) packings.push_back(read_packing(states.at(k)));
  if (packings.empty()) states.refuse(std::string(no_states));
  return packings;
}

/// True if the relaxation to minima has changed a state.
bool has_moved(const JamResult& jam, const RecordedReplicate& held) {
  for (std::size_t k = 0; k < jam.state_steps.size(); ++k) {
    const auto& step = jam.path[static_cast<std::size_t>(jam.state_steps[k])];
    if (held.document.states.at(k).step.descents != step.descents) return true;
  }
  return false;
}

/// True if only the nearest state is known.
bool lacks_states(const JamResult& jam) {
  return std::any_of(jam.states.begin(), jam.states.end(), [](const Packing& state) { return state.size() == 0; });
}

/// The measurement after the nearest state has moved and only this state is known. Other states keep their values.
Measurement with_nearest(Measurement recorded, const Measurement& measured, const JamResult& jam) {
  const auto nearest = *nearest_state(jam);
  recorded.states.at(nearest) = measured.states.at(nearest);
  recorded.replicate = measured.replicate;
  recorded.flags = measured.flags;
  return recorded;
}

}  // namespace

Additions additions(const fs::path& directory, const Requests& requests, const std::vector<Measure>& measures,
                    const std::vector<std::string>& names) {
  Additions result;
  for (const auto& name : names) {
    const auto held = read_record(directory, name);
    if (lacks(held, measures).empty()) continue;
    auto spec = requested(requests, name);
    const auto digest = spec ? std::optional(spec_digest(*spec)) : std::nullopt;
    if (const auto standing = standing_of(held, digest); standing != Standing::requested) {
      const bool is_superseded = standing == Standing::superseded;
      result.impossible.push_back(
          {name, is_superseded ? "it failed, and its settings have changed since" : std::string(other_manifest)});
      continue;
    }
    spec->measures = measures;
    spec->measures.insert(spec->measures.end(), held.summary.measures.begin(), held.summary.measures.end());
    sort_measures(spec->measures);
    if (!held.summary.failed) {
      if (const auto why = without_states(directory, held)) {
        result.impossible.push_back({name, *why});
      } else {
        if (!has_path(directory, held) && held.document.states.size() > 1) result.nearest_only.push_back(name);
        result.measured.push_back(*std::move(spec));
      }
    } else if (failed_before_measures(held)) {
      result.failed.push_back(*std::move(spec));
    } else {
      result.impossible.push_back({name, "it failed in a measure, so its states were not saved"});
    }
  }
  return result;
}

Adder::Adder(const Store& store, const std::vector<ReplicateSpec>& replicates) : store_(store) {
  // Replicates run at the same time. All entries are made here, so that they only look up their own entry later.
  for (const auto& spec : replicates) records_[replicate_name(spec)];
}

Stages Adder::stages() {
  Stages stages;
  stages.begin = [this](const ReplicateSpec& spec) -> Checkpoint {
    const auto& directory = store_.directory();
    auto& held = records_.at(replicate_name(spec));
    held = read_record(directory, replicate_name(spec));
    auto jam = restored_jam(held->document, packings_of(directory, *held), spec, store_.record_path(spec).string());
    auto progress = begin_decompression(jam.states.at(*nearest_state(jam)), spec.options);
    progress.result = std::move(jam);
    return {std::move(progress), {}};
  };
  stages.jam = [this](const ReplicateSpec& spec, JamProgress from, const std::stop_token& stop, const OnProgress&) {
    auto result = std::move(from.result);
    const auto& had = records_.at(replicate_name(spec))->summary.measures;
    if (needs_minima(spec.measures) && !needs_minima(had)) settle(result, spec.options, stop);
    return result;
  };
  stages.measure = [this](const ReplicateSpec& spec, Measure what, const JamResult& jam) {
    const auto& held = *records_.at(replicate_name(spec));
    const bool recorded = has(held.summary.measures, what);
    if (recorded && !has_moved(jam, held)) return recorded_measurement(what, held.record);
    if (!lacks_states(jam)) return measure(what, jam, measure_options(spec));
    auto measured = measure_nearest(what, jam, measure_options(spec));
    return recorded ? with_nearest(recorded_measurement(what, held.record), measured, jam) : measured;
  };
  return stages;
}

std::optional<std::string> Adder::finish(const Outcome& outcome) {
  const auto name = replicate_name(outcome.spec);
  const auto held = std::exchange(records_.at(name), std::nullopt);
  if (outcome.failure) return fmt::format("{} failed in {}: {}", name, outcome.failure->where, outcome.failure->why);
  try {
    const auto file = store_.record_path(outcome.spec).string();
    if (read_sealed(file) != held->record)
      throw InputError({file, "", "was changed by another process", "", "", "repeat the command"});
    store_.write_added(outcome, *held, has_moved(outcome.jam, *held));
    return std::nullopt;
  } catch (const InputError& error) {
    return error.what();
  }
}

}  // namespace isojam
