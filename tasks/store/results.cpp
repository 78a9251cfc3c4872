#include "tasks/store/results.hpp"

#include <fmt/format.h>

#include <system_error>

#include "tasks/json/input_error.hpp"
#include "tasks/json/parse.hpp"
#include "tasks/json/sealed.hpp"
#include "tasks/replicate/packing_json.hpp"
#include "tasks/replicate/summary.hpp"
#include "tasks/store/store.hpp"
#include "tasks/system/file.hpp"

namespace isojam {
namespace fs = std::filesystem;
namespace {

/// A report is made of records; a manifest that was edited or lost since only costs it the sweep's name.
Json lenient_manifest(const fs::path& path) {
  try {
    return read_json(path.string());
  } catch (const InputError&) {
    return nullptr;
  } catch (const FileError&) {
    return nullptr;
  }
}

}  // namespace

Results read_results(const fs::path& directory) {
  Results results;
  const auto folder = directory / "records";
  for (const auto& name : names_in(folder)) {
    const auto path = folder / (name + ".json");
    auto record = read_sealed(path.string());
    auto summary = summarise_record(record, path.string());
    results.replicates.push_back({name, std::move(record), std::move(summary)});
  }
  if (results.replicates.empty()) throw FileError(fmt::format("{}: holds no records", directory.string()));
  results.manifest = lenient_manifest(directory / "manifest.json");
  return results;
}

std::optional<Packing> read_nearest_packing(const fs::path& directory, const std::string& name) {
  const auto path = directory / "packings" / (name + ".json");
  std::error_code error;
  if (!fs::exists(path, error)) return std::nullopt;
  const auto json = read_sealed(path.string());
  return read_packing({json, path.string()});
}

}  // namespace isojam
