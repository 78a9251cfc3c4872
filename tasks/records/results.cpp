#include "tasks/records/results.hpp"

#include <system_error>
#include <utility>

#include "tasks/packings/packing_json.hpp"

namespace isojam {
namespace fs = std::filesystem;
namespace {

/// The part of a replicate that a report needs, which takes much less memory: of the path, only the reasons why steps
/// stopped.
RecordedReplicate shortened(RecordedReplicate held) {
  Record document;
  document.provenance = std::move(held.document.provenance);
  held.document = std::move(document);
  Json path = Json::array();
  for (const auto& step : held.record.at("path"))
    path.push_back({{"stage", step.at("stage")}, {"stopped", step.at("stopped")}});
  held.record["path"] = std::move(path);
  return held;
}

}  // namespace

Results read_results(const fs::path& directory, const Warn& warn) {
  Results results;
  if (const auto manifest = stored_manifest(directory)) results.manifest = to_json(*manifest);
  for_each_record(directory, warn,
                  [&](RecordedReplicate held) { results.replicates.push_back(shortened(std::move(held))); });
  return results;
}

std::optional<Packing> read_nearest_packing(const fs::path& directory, const RecordedReplicate& replicate) {
  const auto file = directory / "packings" / (replicate.name + ".json");
  std::error_code error;
  if (!fs::exists(file, error)) return std::nullopt;
  const auto json = read_state_file_of(directory, replicate, "packings");
  return read_packing({json, file.string()});
}

}  // namespace isojam
