#include "tasks/store/store.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <system_error>

#include "tasks/json/input_error.hpp"
#include "tasks/json/sealed.hpp"
#include "tasks/replicate/checkpoint.hpp"
#include "tasks/replicate/record.hpp"
#include "tasks/replicate/summary.hpp"
#include "tasks/store/in_order.hpp"
#include "tasks/system/atomic_file.hpp"
#include "tasks/system/file.hpp"

namespace isojam {
namespace fs = std::filesystem;
namespace {

[[noreturn]] void refuse_other(const std::string& file, std::string pointer, const std::string& theirs,
                               const std::string& ours) {
  throw InputError({file, std::move(pointer), fmt::format("belongs to another manifest (digest {})", theirs),
                    fmt::format("results of this manifest (digest {}): choose another directory with -o", ours), ""});
}

/// The manifest that the directory belongs to already.
std::optional<Manifest> manifest_in(const fs::path& path, const std::string& ours) {
  std::error_code error;
  if (!fs::exists(path, error)) return std::nullopt;
  const auto theirs = read_manifest(path.string());
  if (digest(theirs) != ours) refuse_other(path.string(), "", digest(theirs), ours);
  return theirs;
}

/// Records that the plan does not know; all of them where no manifest says whose the directory is.
void check_records(const fs::path& folder, const Manifest& manifest, bool all) {
  const auto names = names_in(folder);
  if (names.empty()) return;
  const Plan plan(manifest);
  const auto ours = digest(manifest);
  for (const auto& name : names) {
    const bool planned = plan.place_of(name).has_value();
    if (planned && !all) continue;
    const auto path = (folder / (name + ".json")).string();
    try {
      const auto theirs = summarise_record(read_sealed(path), path).manifest_digest;
      if (theirs != ours) refuse_other(path, "/provenance/manifest_digest", theirs, ours);
    } catch (const InputError& damage) {
      // One that is planned is redone when its turn comes.
      if (!planned || !damage.details().pointer.starts_with("/checksum")) throw;
    }
  }
}

void make_folder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) throw FileError(fmt::format("{}: cannot be created: {}", folder.string(), error.message()));
}

/// Within a results directory.
void make_own_folder(const fs::path& folder) {
  std::error_code error;
  if (fs::is_symlink(fs::symlink_status(folder, error)))
    throw FileError(
        fmt::format("{}: is a symbolic link; results are written to folders of the directory itself", folder.string()));
  make_folder(folder);
  remove_stale_temporaries(folder);
}

/// Those that a writer leaves that is killed after the record and before its checkpoint went.
void remove_outlived_checkpoints(const fs::path& directory) {
  for (const auto& name : names_in(directory / "checkpoints")) {
    std::error_code gone;
    if (fs::exists(directory / "records" / (name + ".json"), gone))
      fs::remove(directory / "checkpoints" / (name + ".json"), gone);
  }
}

/// A plan only grows: records beyond a smaller number of replicates are kept and counted.
Manifest grown(Manifest manifest, const std::optional<Manifest>& before) {
  if (before) manifest.replicates.max = std::max(manifest.replicates.max, before->replicates.max);
  if (before && !manifest.replicates.goal) manifest.replicates.min = manifest.replicates.max;
  return manifest;
}

void check_seal_of(const fs::path& path) { check_seal(read_text(path.string()), path.string()); }

}  // namespace

Store::Store(fs::path directory, const Manifest& manifest)
    : directory_(std::move(directory)), digest_(digest(manifest)), keep_path_(manifest.keep_path) {
  const auto manifest_path = directory_ / "manifest.json";
  const auto before = manifest_in(manifest_path, digest_);
  check_records(directory_ / "records", manifest, !before);

  make_folder(directory_);
  for (const auto* folder : {"records", "packings", "checkpoints"}) make_own_folder(directory_ / folder);
  if (keep_path_) make_own_folder(directory_ / "paths");
  remove_outlived_checkpoints(directory_);
  check_writable(directory_ / "records");
  const auto text = pretty(to_json(grown(manifest, before)));
  if (!before || text != pretty(to_json(*before))) write_atomically(manifest_path, text);
}

fs::path Store::file(const char* folder, const ReplicateSpec& spec) const {
  return directory_ / folder / (replicate_name(spec) + ".json");
}

std::optional<RecordSummary> Store::recorded(const ReplicateSpec& spec, const Warn& warn) const {
  const auto path = record_path(spec);
  std::error_code error;
  if (!fs::exists(path, error)) return std::nullopt;
  std::optional<RecordSummary> summary;
  try {
    const auto record = read_sealed(path.string());
    summary = summarise_record(record, path.string());
    if (record.at("spec") != to_json(spec))
      throw InputError({path.string(), "/spec", "is not the replicate that the name says", "", ""});
    if (!summary->failed) check_seal_of(packing_path(spec));
    if (!summary->failed && keep_path_) check_seal_of(path_path(spec));
  } catch (const std::runtime_error& damage) {
    warn(fmt::format("{}; the replicate is redone", damage.what()));
    return std::nullopt;
  }
  if (summary->manifest_digest != digest_)
    refuse_other(path.string(), "/provenance/manifest_digest", summary->manifest_digest, digest_);
  return summary;
}

std::optional<Checkpoint> Store::checkpoint(const ReplicateSpec& spec, const Warn& warn) const {
  const auto path = checkpoint_path(spec);
  std::error_code error;
  if (!fs::exists(path, error)) return std::nullopt;
  try {
    const auto document = read_sealed(path.string());
    return read_checkpoint({document, path.string()}, spec);
  } catch (const std::runtime_error& damage) {
    warn(fmt::format("{}; the replicate starts anew", damage.what()));
    return std::nullopt;
  }
}

void Store::write_checkpoint(const ReplicateSpec& spec, const Checkpoint& checkpoint) const {
  // Not synchronised: what a power failure cuts short is noticed, and costs this replicate only.
  if (const auto document = make_checkpoint(spec, checkpoint))
    write_atomically(checkpoint_path(spec), sealed(*document), Durability::lossless);
}

void Store::write(const Outcome& outcome) const {
  if (!outcome.failure) write_atomically(packing_path(outcome.spec), sealed(make_packing(outcome)));
  if (!outcome.failure && keep_path_) write_atomically(path_path(outcome.spec), sealed(make_path(outcome)));
  write_atomically(record_path(outcome.spec), sealed(make_record(outcome)));
  // One that stays is of no consequence, for the record comes first, and goes with the next run.
  std::error_code ignored;
  fs::remove(checkpoint_path(outcome.spec), ignored);
}

void Store::write_tables(const Json& tables) const { write_atomically(tables_path(), pretty(tables)); }

std::vector<std::string> names_in(const fs::path& folder) {
  std::vector<std::string> names;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder, error)) {
    const auto name = entry.path().filename().string();
    if (name.front() != '.' && entry.path().extension() == ".json") names.push_back(entry.path().stem().string());
  }
  if (error && error != std::errc::no_such_file_or_directory)
    throw FileError(fmt::format("{}: cannot be listed: {}", folder.string(), error.message()));
  std::sort(names.begin(), names.end());
  return names;
}

void for_each_record(const fs::path& directory, const std::function<void(const RecordSummary&)>& use) {
  const auto names = names_in(directory / "records");
  if (names.empty()) throw FileError(fmt::format("{}: holds no records", directory.string()));
  const auto summary_of = [&](std::size_t index) {
    const auto path = (directory / "records" / (names[index] + ".json")).string();
    return summarise_record(read_sealed(path), path);
  };
  in_order(names.size(), summary_of, use);
}

}  // namespace isojam
