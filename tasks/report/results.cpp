#include "tasks/report/results.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <system_error>

#include "tasks/input_error.hpp"
#include "tasks/packing_json.hpp"
#include "tasks/sealed_json.hpp"

namespace isojam {
namespace fs = std::filesystem;
namespace {

/// Records, ordered by name; temporaries of a writer that was killed begin with a dot.
std::vector<fs::path> record_files(const fs::path& directory) {
  std::vector<fs::path> files;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(directory / "records", error)) {
    const auto& path = entry.path();
    if (path.filename().string().front() != '.' && path.extension() == ".json") files.push_back(path);
  }
  if (files.empty()) throw FileError(fmt::format("{}: holds no records", directory.string()));
  std::sort(files.begin(), files.end());
  return files;
}

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
  for (const auto& path : record_files(directory)) {
    auto record = read_sealed(path.string());
    auto summary = summarise_record(record, path.string());
    results.replicates.push_back({path.stem().string(), std::move(record), std::move(summary)});
  }
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
