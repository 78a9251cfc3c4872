#include "tasks/run/adding.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <utility>

#include "engine/vibration/settle.hpp"
#include "tasks/json/input_error.hpp"
#include "tasks/json/place.hpp"
#include "tasks/measure/recorded_measurement.hpp"
#include "tasks/packings/packing_json.hpp"
#include "tasks/replicate/restored.hpp"
#include "tasks/system/file.hpp"

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

/// Whether a replicate failed on the way to its states, and not when they were measured.
bool failed_before_measures(const RecordedReplicate& held) {
  return !from_string<Measure>(held.record.at("failure").at("where").get_ref<const std::string&>());
}

/// Why nothing of a replicate without failure can be measured any more; nullopt if it can.
std::optional<std::string> without_path(const fs::path& directory, const RecordedReplicate& held) {
  try {
    check_companions(directory, held, true);
    return std::nullopt;
  } catch (const InputError& error) {
    return error.what();
  } catch (const FileError& error) {
    if (error.reason() != FileError::Reason::missing) throw;
    return fmt::format("{}; expansions are kept by \"keep_path\": true in the manifest, before the run", error.what());
  }
}

std::vector<Packing> packings_of(const fs::path& directory, const RecordedReplicate& held) {
  const auto json = read_companion_of(directory, held, "paths");
  const auto states = JsonPlace(json, file_of(directory, "paths", held.name)).at("states");
  std::vector<Packing> packings;
  const auto count = states.expect_list("a list of states");
  for (std::size_t k = 0; k < count; ++k) packings.push_back(read_packing(states.at(k)));
  if (packings.empty()) states.refuse("the expansion has no states");
  return packings;
}

}  // namespace

Additions additions(const fs::path& directory, const Plan& plan, const std::vector<std::string>& names) {
  Additions result;
  for (const auto& name : names) {
    const auto held = read_record(directory, name);
    const auto place = plan.place_of(name);
    if (!place || !is_of(held, plan.manifest()))
      throw InputError({file_of(directory, "records", name), "/provenance/manifest_digest",
                        "belongs to another manifest than the directory", plan.manifest_digest(), ""});
    if (lacks(held, plan.manifest()).empty()) continue;
    auto spec = plan.at(place->point, place->replicate);
    if (!held.summary.failed) {
      if (const auto why = without_path(directory, held)) {
        result.impossible.push_back({name, *why});
      } else {
        result.measured.push_back(std::move(spec));
      }
    } else if (failed_before_measures(held)) {
      result.failed.push_back(std::move(spec));
    } else {
      result.impossible.push_back({name, name + ": failed in a measure, and its states were not kept"});
    }
  }
  return result;
}

bool has_moved(const JamResult& jam, const RecordedReplicate& held) {
  const auto& states = held.record.at("states");
  for (std::size_t k = 0; k < jam.state_steps.size(); ++k) {
    const auto& step = jam.path[static_cast<std::size_t>(jam.state_steps[k])];
    if (states.at(k).at("descents") != step.descents) return true;
  }
  return false;
}

Stages adding_stages(const fs::path& directory) {
  Stages stages;
  stages.begin = [directory](const ReplicateSpec& spec) -> Checkpoint {
    const auto held = read_record(directory, replicate_name(spec));
    const JsonPlace record(held.record, file_of(directory, "records", held.name));
    auto jam = restored_jam(record, packings_of(directory, held), spec);
    auto progress = begin_expansion(jam.states.back(), spec.options);
    progress.result = std::move(jam);
    return {std::move(progress), {}};
  };
  stages.jam = [directory](const ReplicateSpec& spec, JamProgress from, const std::stop_token& stop,
                           const OnProgress&) {
    auto result = std::move(from.result);
    const auto held = read_record(directory, replicate_name(spec));
    if (needs_minima(spec.measures) && !needs_minima(held.summary.measures)) settle(result, spec.options, stop);
    return result;
  };
  stages.measure = [directory](const ReplicateSpec& spec, Measure what, const JamResult& jam) {
    const auto held = read_record(directory, replicate_name(spec));
    if (has(held.summary.measures, what) && !has_moved(jam, held)) return recorded_measurement(what, held.record);
    return measure(what, jam, spec.measuring);
  };
  return stages;
}

}  // namespace isojam
