#include "tasks/records/results.hpp"

#include <system_error>
#include <utility>

#include "tasks/packings/packing_json.hpp"

namespace isojam {
namespace fs = std::filesystem;

Results read_results(const fs::path& directory, const Warn& warn) {
  Results results;
  if (const auto manifest = stored_manifest(directory)) results.manifest = to_json(*manifest);
  for_each_record(directory, warn, [&](RecordedReplicate held) { results.replicates.push_back(std::move(held)); });
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
