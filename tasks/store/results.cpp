#include "tasks/store/results.hpp"

#include <fmt/format.h>

#include "tasks/json/input_error.hpp"
#include "tasks/replicate/packing_json.hpp"
#include "tasks/system/file.hpp"

namespace isojam {
namespace fs = std::filesystem;
namespace {

/// A report is made of records; a manifest that was edited or lost since only costs it the sweep's name.
void read_leniently(const fs::path& directory, Results& results) {
  try {
    if (const auto manifest = stored_manifest(directory)) results.manifest = to_json(*manifest);
  } catch (const InputError& error) {
    results.manifest_problem = error.what();
  }
}

}  // namespace

Results read_results(const fs::path& directory) {
  Results results;
  for (const auto& name : names_in(directory / "records")) results.replicates.push_back(read_record(directory, name));
  if (results.replicates.empty()) throw FileError(fmt::format("{}: holds no records", directory.string()));
  read_leniently(directory, results);
  return results;
}

std::optional<Packing> read_nearest_packing(const fs::path& directory, const RecordedReplicate& replicate) {
  try {
    const auto json = read_companion_of(directory, replicate, "packings");
    return read_packing({json, (directory / "packings" / (replicate.name + ".json")).string()});
  } catch (const FileError& error) {
    if (error.reason() != FileError::Reason::missing) throw;
    return std::nullopt;
  }
}

}  // namespace isojam
