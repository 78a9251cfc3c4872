#include "tasks/run/additions.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <utility>

#include "engine/vibration/settle.hpp"
#include "tasks/io/file.hpp"
#include "tasks/io/input_error.hpp"
#include "tasks/io/place.hpp"
#include "tasks/io/sealed.hpp"
#include "tasks/measure/recorded_measurement.hpp"
#include "tasks/packings/packing_json.hpp"
#include "tasks/records/earlier_record.hpp"
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
  return !from_string<Measure>(held.record.at("failure").at("where").get_ref<const std::string&>());
}

/// Reason why the states of a successful replicate can no longer be measured; nullopt if they can.
std::optional<std::string> without_path(const fs::path& directory, const RecordedReplicate& held) {
  if (!fs::exists(file_of(directory, "paths", held.name))) return std::string(states_not_saved);
  try {
    check_companions(directory, held, true);
    return std::nullopt;
  } catch (const InputError& error) {
    return error.what();
  }
}

std::vector<Packing> packings_of(const fs::path& directory, const RecordedReplicate& held) {
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
  const auto& states = held.record.at("states");
  for (std::size_t k = 0; k < jam.state_steps.size(); ++k) {
    const auto& step = jam.path[static_cast<std::size_t>(jam.state_steps[k])];
    if (states.at(k).at("descents") != step.descents) return true;
  }
  return false;
}

}  // namespace

Additions additions(const fs::path& directory, const Plan& plan, const std::vector<std::string>& names) {
  Additions result;
  for (const auto& name : names) {
    const auto held = read_record(directory, name);
    const auto place = plan.place_of(name);
    if (!place || !is_of(held, plan.manifest()))
      throw InputError({file_of(directory, "records", name), "/provenance/manifest_digest", std::string(other_manifest),
                        plan.manifest_digest(), ""});
    if (lacks(held, plan.manifest()).empty()) continue;
    auto spec = plan.at(place->point, place->replicate);
    if (held.is_earlier) {
      result.impossible.push_back({name, fmt::format("{}: the record has the schema {} of an earlier version, to which "
                                                     "nothing can be added; remove it and run it again",
                                                     name, earlier_record_schema)});
    } else if (!held.summary.failed) {
      if (const auto why = without_path(directory, held)) {
        result.impossible.push_back({name, *why});
      } else {
        result.measured.push_back(std::move(spec));
      }
    } else if (failed_before_measures(held)) {
      result.failed.push_back(std::move(spec));
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
    auto jam = restored_jam({held->record, store_.record_path(spec).string()}, packings_of(directory, *held), spec);
    auto progress = begin_expansion(jam.states.back(), spec.options);
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
    if (has(held.summary.measures, what) && !has_moved(jam, held)) return recorded_measurement(what, held.record);
    return measure(what, jam, spec.measuring);
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
