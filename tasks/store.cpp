#include "tasks/store.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <system_error>

#include "tasks/atomic_file.hpp"
#include "tasks/input_error.hpp"

namespace isojam {
namespace fs = std::filesystem;
namespace {

/// Names of results in a directory, ordered; temporaries of a writer that was killed begin with a dot.
std::vector<fs::path> json_files(const fs::path& directory) {
  std::vector<fs::path> files;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(directory, error)) {
    const auto name = entry.path().filename().string();
    if (name.front() != '.' && entry.path().extension() == ".json") files.push_back(entry.path());
  }
  if (error && error != std::errc::no_such_file_or_directory) {
    throw FileError(fmt::format("{}: cannot be listed: {}", directory.string(), error.message()));
  }
  std::sort(files.begin(), files.end());
  return files;
}

[[noreturn]] void refuse_other(const std::string& file, std::string pointer, const std::string& theirs,
                               const std::string& ours) {
  throw InputError({file, std::move(pointer), fmt::format("belongs to another manifest (digest {})", theirs),
                    fmt::format("results of this manifest (digest {}): choose another directory with -o", ours), ""});
}

/// Number of replicates of the manifest that the directory already belongs to; 0 if it belongs to none.
int check_manifest(const fs::path& path, const std::string& ours) {
  std::error_code error;
  if (!fs::exists(path, error)) return 0;
  const auto theirs = read_manifest(path.string());
  if (digest(theirs) != ours) refuse_other(path.string(), "", digest(theirs), ours);
  return theirs.replicates;
}

void check_records(const fs::path& directory, const std::string& ours, const std::set<std::string>& planned) {
  for (const auto& path : json_files(directory)) {
    std::string theirs;
    try {
      theirs = summarise_record(read_json(path.string()), path.string()).manifest_digest;
    } catch (const InputError&) {
      if (!planned.contains(path.stem().string())) throw;
      continue;  // holds() reports it, and the run writes it anew
    }
    if (theirs != ours) refuse_other(path.string(), "/provenance/manifest_digest", theirs, ours);
  }
}

void make_directory(const fs::path& directory) {
  std::error_code error;
  fs::create_directories(directory, error);
  if (error) throw FileError(fmt::format("{}: cannot be created: {}", directory.string(), error.message()));
}

}  // namespace

Store::Store(fs::path directory, const Manifest& manifest) : directory_(std::move(directory)) {
  const auto ours = digest(manifest);
  std::set<std::string> planned;
  for (const auto& spec : make_plan(manifest)) planned.insert(replicate_name(spec));
  const auto manifest_path = directory_ / "manifest.json";
  const int planned_before = check_manifest(manifest_path, ours);
  check_records(directory_ / "records", ours, planned);

  make_directory(directory_ / "records");
  make_directory(directory_ / "packings");
  // A plan only grows: records beyond a smaller number of replicates are kept and counted.
  if (manifest.replicates > planned_before) write_atomically(manifest_path, pretty(to_json(manifest)));
}

fs::path Store::record_path(const ReplicateSpec& spec) const {
  return directory_ / "records" / (replicate_name(spec) + ".json");
}

fs::path Store::packing_path(const ReplicateSpec& spec) const {
  return directory_ / "packings" / (replicate_name(spec) + ".json");
}

bool Store::holds(const ReplicateSpec& spec, const Warn& warn) const {
  const auto path = record_path(spec);
  std::error_code error;
  if (!fs::exists(path, error)) return false;
  try {
    const auto record = read_json(path.string());
    const auto summary = summarise_record(record, path.string());
    if (record.at("spec") != to_json(spec)) {
      warn(fmt::format("{}: /spec: is not the replicate that the name says; it is redone", path.string()));
      return false;
    }
    if (summary.failed) return true;
    read_json(packing_path(spec).string());
    return true;
  } catch (const std::runtime_error& damage) {
    warn(fmt::format("{}; the replicate is redone", damage.what()));
    return false;
  }
}

void Store::write(const Outcome& outcome) const {
  if (!outcome.failure) write_atomically(packing_path(outcome.spec), pretty(make_packing(outcome)));
  write_atomically(record_path(outcome.spec), pretty(make_record(outcome)));
}

void Store::write_tables(const Json& tables) const { write_atomically(tables_path(), pretty(tables)); }

std::vector<std::string> recorded_names(const fs::path& directory) {
  std::vector<std::string> names;
  for (const auto& path : json_files(directory / "records")) names.push_back(path.stem().string());
  if (names.empty()) throw FileError(fmt::format("{}: holds no records", directory.string()));
  return names;
}

std::vector<RecordSummary> read_records(const fs::path& directory) {
  std::vector<RecordSummary> summaries;
  for (const auto& path : json_files(directory / "records")) {
    summaries.push_back(summarise_record(read_json(path.string()), path.string()));
  }
  if (summaries.empty()) throw FileError(fmt::format("{}: holds no records", directory.string()));
  return summaries;
}

}  // namespace isojam
