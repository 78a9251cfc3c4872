#include "tasks/records/store.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <system_error>

#include "tasks/io/atomic_file.hpp"
#include "tasks/io/file.hpp"
#include "tasks/io/input_error.hpp"
#include "tasks/io/sealed.hpp"
#include "tasks/records/checkpoint.hpp"
#include "tasks/records/record.hpp"
#include "tasks/records/summary.hpp"
#include "tasks/records/texts.hpp"

namespace isojam {
namespace fs = std::filesystem;
namespace {

constexpr auto recomputed = "the replicate is recomputed";

void make_folder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) throw FileError::of_error(folder, "cannot be created", error);
}

void refuse_links(const fs::path& directory) {
  std::error_code error;
  for (const auto* name : {"records", "packings", "paths", "checkpoints"}) {
    if (fs::is_symlink(fs::symlink_status(directory / name, error)))
      throw FileError(fmt::format("{}: is a symbolic link; replace it by a folder", (directory / name).string()));
  }
}

/// Makes a results directory or a folder inside it, and removes old temporary files from it.
void make_own_folder(const fs::path& folder) {
  make_folder(folder);
  remove_stale_temporaries(folder);
}

/// Removes the checkpoints of replicates that have a record. They remain if a run is killed after it wrote a record and
/// before it removed the checkpoint.
void remove_outlived_checkpoints(const fs::path& directory) {
  for (const auto& name : names_in(directory / "checkpoints")) {
    std::error_code gone;
    if (fs::exists(directory / "records" / (name + ".json"), gone))
      fs::remove(directory / "checkpoints" / (name + ".json"), gone);
  }
}

/// True if a file has its checksum.
bool is_whole(const fs::path& file) {
  try {
    check_seal(read_file(file), file.string());
    return true;
  } catch (const InputError&) {
    return false;
  }
}

/// Removes a damaged manifest.json, of which manifests/ has a copy.
void remove_damaged_manifest(const fs::path& directory, const Warn& warn) {
  try {
    stored_manifest(directory);
  } catch (const InputError& error) {
    if (is_whole(directory / "manifest.json")) throw;
    warn(problem_line(error.details()) + "; the file is replaced");
    fs::remove(directory / "manifest.json");
  }
}

/// Locks the directory. A manifest that is in conflict with a later one begins only while nobody uses the directory.
DirectoryLock lock_for(const fs::path& directory, const Manifest& manifest, const Warn& warn,
                       DirectoryLock::Kind kind) {
  const Plan plan(manifest);
  const auto json = to_json(manifest);
  for (const auto& other : requests_in(directory, warn)) {
    if (to_json(other.manifest()) == json) break;
    if (are_in_conflict(plan, other)) kind = DirectoryLock::Kind::exclusive;
  }
  auto lock = DirectoryLock::take(directory, kind);
  if (!lock)
    throw FileError(
        directory.string() +
            ": another process of isojam is using this directory; repeat this command after that process has ended",
        FileError::Reason::resource_failure);
  return *std::move(lock);
}

/// Warns of records that have a problem, if there are any.
void warn_of(const std::vector<std::string>& names, const fs::path& directory, const char* problem, const char* effect,
             const Warn& warn) {
  if (names.empty()) return;
  warn(fmt::format("{}: {} {} of the records, for example {}; they {}", directory.string(), problem, names.size(),
                   names.front(), effect));
}

}  // namespace

void throw_without_records(const fs::path& directory) {
  expect_directory(directory);
  std::error_code ignored;
  const auto problem = fs::exists(directory / "manifest.json", ignored)
                           ? std::string(no_records)
                           : fmt::format("{}; {}", no_results, how_to_get_results);
  throw FileError(fmt::format("{}: {}", directory.string(), problem), FileError::Reason::missing);
}

void check_directory(const fs::path& directory, const Manifest& manifest, const Requests& accepted) {
  refuse_links(directory);
  const Plan plan(manifest);
  const auto json = to_json(manifest);
  const auto is_same = [&](const Plan& other) { return to_json(other.manifest()) == json; };
  if (std::any_of(accepted.begin(), accepted.end(), is_same)) return;
  for (const auto& name : names_in(directory / "records")) {
    const auto place = plan.place_of(name);
    if (!place || !plan.requests(*place)) continue;
    const auto spec = plan.at(place->point, place->replicate);
    if (is_requested(accepted, name, spec_digest(spec))) continue;
    std::optional<RecordedReplicate> held;
    try {
      held = read_record(directory, name, Abridgement{States::nearest});
    } catch (const InputError&) {
      continue;
    }
    if (standing_of(*held, spec_digest(spec)) == Standing::foreign) throw conflict_of(directory, *held, spec);
  }
}

Store::Store(fs::path directory, const Manifest& manifest, Warn warn, DirectoryLock::Kind kind)
    : directory_(std::move(directory)), manifest_(manifest), warn_(std::move(warn)) {
  if (std::error_code error; fs::exists(directory_, error) && !fs::is_directory(directory_, error))
    throw FileError(directory_.string() + ": is a file; give a directory with -o", FileError::Reason::missing);
  refuse_links(directory_);
  make_own_folder(directory_);
  make_own_folder(directory_ / "manifests");
  const auto turn = DirectoryLock::wait_for(directory_ / "manifests");
  remove_damaged_manifest(directory_, warn_);
  check_directory(directory_, manifest, requests_in(directory_, warn_));
  lock_ = lock_for(directory_, manifest, warn_, kind);
  request(directory_, manifest);
  for (const auto* folder : {"records", "packings", "checkpoints"}) make_own_folder(directory_ / folder);
  if (manifest.keep_path) make_own_folder(directory_ / "paths");
  remove_outlived_checkpoints(directory_);
  check_writable(directory_ / "records");
  locks_.emplace(directory_ / "checkpoints" / ".locks");
  if (kind == DirectoryLock::Kind::shared) lock_->share();
}

fs::path Store::file(const char* folder, const ReplicateSpec& spec) const {
  return directory_ / folder / (replicate_name(spec) + ".json");
}

std::optional<RecordSummary> Store::recorded(const ReplicateSpec& spec) const {
  const auto path = record_path(spec).string();
  std::error_code error;
  if (fs::symlink_status(path, error).type() == fs::file_type::not_found) return std::nullopt;
  try {
    auto held = read_record(directory_, replicate_name(spec));
    const auto standing = standing_of(held, spec_digest(spec));
    if (standing == Standing::superseded) return std::nullopt;
    if (standing == Standing::requested) {
      check_companions(directory_, held, manifest_.keep_path);
      if (lacks(held, spec.measures).empty()) return std::move(held.summary);
      warn_(path + ": lacks measures of the manifest; " + recomputed +
            " (\"isojam measure\" would add them in less time)");
      return std::nullopt;
    }
    warn_(problem_line(conflict_of(directory_, held, spec).details()) + "; this replicate is left out");
    RecordSummary taken;
    taken.spec_digest = held.summary.spec_digest;
    taken.failed = true;
    return taken;
  } catch (const InputError& damage) {
    warn_(fmt::format("{}; {}", problem_line(damage.details()), recomputed));
    return std::nullopt;
  }
}

void Store::keep_measures(ReplicateSpec& spec) const {
  try {
    const auto held = read_record(directory_, replicate_name(spec));
    if (held.summary.spec_digest != spec_digest(spec)) return;
    spec.measures.insert(spec.measures.end(), held.summary.measures.begin(), held.summary.measures.end());
    sort_measures(spec.measures);
  } catch (const InputError&) {
    return;  // there is no record, or it is damaged
  }
}

std::optional<Checkpoint> Store::checkpoint(const ReplicateSpec& spec) const {
  const auto path = checkpoint_path(spec).string();
  try {
    const auto document = read_sealed(path);
    return read_checkpoint({document, path}, spec);
  } catch (const InputError& damage) {
    warn_(fmt::format("{}; the replicate starts from the beginning", problem_line(damage.details())));
  } catch (const FileError& error) {
    if (error.reason() != FileError::Reason::missing) throw;
  }
  return std::nullopt;
}

void Store::write_checkpoint(const ReplicateSpec& spec, const Checkpoint& checkpoint) const {
  // The checkpoint is not synchronised to disk. If a power failure truncates it, isojam detects this and recomputes
  // only this replicate.
  if (const auto document = make_checkpoint(spec, checkpoint))
    write_atomically(checkpoint_path(spec), sealed(*document), Durability::lossless);
}

void Store::write(const Outcome& outcome) const {
  const auto record = make_record(outcome);
  const auto digest = record.at("result_digest").get<std::string>();
  if (!outcome.failure) write_atomically(packing_path(outcome.spec), sealed(make_packing(outcome, digest)));
  if (!outcome.failure && manifest_.keep_path)
    write_atomically(path_path(outcome.spec), sealed(make_path(outcome, digest)));
  write_atomically(record_path(outcome.spec), sealed(record));
  // If the checkpoint cannot be removed, it does no harm: the record takes precedence, and the next run removes the
  // checkpoint.
  std::error_code ignored;
  fs::remove(checkpoint_path(outcome.spec), ignored);
  release(outcome.spec);
}

void Store::write_added(const Outcome& outcome, const RecordedReplicate& before, bool moved) const {
  Outcome again = outcome;
  again.spec.measures = before.summary.measures;
  for (const auto& [what, measurement] : outcome.measured) {
    const auto& had = before.summary.measures;
    if (std::find(had.begin(), had.end(), what) == had.end()) again.measured.erase(what);
  }
  if (!moved && make_record(again).at("result_digest") != before.summary.result_digest)
    throw InputError({record_path(outcome.spec).string(), "/result_digest",
                      "the stored states do not reproduce this record, so measures cannot be added", "", "",
                      fmt::format("run \"isojam rerun {} {}\" first", directory_.string(), before.name)});
  std::vector<Measure> added;
  for (const auto& [what, measurement] : outcome.measured) {
    if (!again.measured.contains(what)) added.push_back(what);
  }
  const auto record = with_added(record_of(outcome), before.document, added);
  const auto digest = record.at("result_digest").get<std::string>();
  if (moved) {
    write_atomically(packing_path(outcome.spec), sealed(make_packing(outcome, digest)));
    // Without a path, the packing of the nearest state is all that is stored.
    if (fs::exists(path_path(outcome.spec)))
      write_atomically(path_path(outcome.spec), sealed(make_path(outcome, digest)));
  }
  write_atomically(record_path(outcome.spec), sealed(record));
}

void Store::write_added(const ReplicateSpec& spec, const RecordedReplicate& failed) const {
  write_atomically(record_path(spec), sealed(with_added(failed_record(failed.document, spec), failed.document, {})));
}

void Store::write_tables(const Json& tables) const { write_atomically(tables_path(), sealed(tables)); }

void for_each_record(const fs::path& directory, const Warn& warn, const std::function<void(RecordedReplicate)>& use,
                     const std::optional<Abridgement>& kept) {
  const auto names = names_in(directory / "records");
  if (names.empty()) throw_without_records(directory);
  const auto requests = requests_in(directory, warn);
  std::vector<std::string> unasked, foreign, superseded;
  read_in_order(names, [&](const std::string& name) -> std::function<void()> {
    std::optional<std::string> digest;
    const auto asks = [&](const auto& plan) {
      const auto place = plan.place_of(name);
      if (place && !digest) digest = plan.digest(*place);
      return place && plan.requests(*place);
    };
    const bool is_asked_for = requests.empty() || std::any_of(requests.begin(), requests.end(), asks);
    std::optional<RecordedReplicate> held;
    try {
      held = read_record(directory, name, kept);
    } catch (const InputError&) {
      if (digest || requests.empty()) throw;
    }
    const auto standing = held && !requests.empty() ? standing_of(*held, digest) : Standing::requested;
    return [&, name, is_asked_for, standing, held = std::move(held)]() mutable {
      if (!held) {
        warn((directory / "records" / (name + ".json")).string() +
             ": is ignored, because no manifest has such a replicate; remove the file, or correct its name");
      } else if (standing == Standing::foreign) {
        const bool is_earlier = is_requested(requests, name, held->summary.spec_digest);
        (is_earlier ? superseded : foreign).push_back(name);
      } else if (standing == Standing::requested) {
        if (!is_asked_for) unasked.push_back(name);
        use(*std::move(held));
      }
    };
  });
  warn_of(unasked, directory, "no manifest requests", "count too", warn);
  warn_of(foreign, directory, "no manifest requests the settings of", "are ignored", warn);
  warn_of(superseded, directory, "only an earlier manifest requests the settings of", "are ignored", warn);
}

}  // namespace isojam
