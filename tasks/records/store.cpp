#include "tasks/records/store.hpp"

#include <fmt/format.h>
#include <tbb/info.h>
#include <tbb/parallel_pipeline.h>

#include <algorithm>
#include <exception>
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

constexpr auto digest_pointer = "/provenance/manifest_digest", recomputed = "the replicate is recomputed";

std::string digests(const std::string& theirs, const std::string& ours) {
  return fmt::format("digest {} instead of {}", theirs, ours);
}

[[noreturn]] void refuse_other(const std::string& file, std::string pointer, const std::string& difference) {
  throw InputError({file, std::move(pointer), fmt::format("{} ({})", other_manifest, difference), "", "",
                    std::string(choose_another_directory)});
}

/// Reports that the manifest requests another result than the one that a record of its plan has.
void refuse_changed(const fs::path& directory, const RecordedReplicate& held, const Plan& plan) {
  const auto place = plan.place_of(held.name);
  auto spec = to_json(plan.at(place->point, place->replicate));
  spec["measure"] = held.record.at("spec").at("measure");
  const auto patch = Json::diff(held.record.at("spec"), spec);
  if (patch.empty()) return;
  const auto pointer = patch.front().at("path").get<std::string>();
  const Json::json_pointer at(pointer);
  const auto shown = [&](const Json& json) { return json.contains(at) ? compact(json.at(at)) : "not given"; };
  throw InputError({(directory / "records" / (held.name + ".json")).string(), "/spec" + pointer,
                    fmt::format("{} in the record, {} in this manifest, and only failed replicates are computed again",
                                shown(held.record.at("spec")), shown(spec)),
                    "", "", fmt::format("restore the setting, or {}", choose_another_directory)});
}

/// Advice for the user if the manifest requests measures that the directory does not have.
std::string how_to_add(const fs::path& directory, const Manifest& theirs, const Manifest& ours) {
  std::string names;
  for (const auto what : ours.measures) {
    if (std::find(theirs.measures.begin(), theirs.measures.end(), what) != theirs.measures.end()) continue;
    names += (names.empty() ? "" : ",") + std::string(to_string(what));
  }
  return fmt::format("set \"measure\" to {}, or run \"isojam measure {} --add {}\" first",
                     compact(to_json(theirs).at("measure")), directory.string(), names);
}

/// True if both manifests have the same parameters for each single solid of `part`.
bool has_settings_of(const Manifest& whole, const Manifest& part) {
  const auto own = [](const Manifest& manifest, const Mixture& solid) {
    const auto found = manifest.by_solid.find(to_string(solid));
    return found == manifest.by_solid.end() ? Json() : found->second.parameters;
  };
  return std::all_of(part.solids.begin(), part.solids.end(),
                     [&](const Mixture& solid) { return own(whole, solid) == own(part, solid); });
}

/// Manifest of the directory; nullopt if it has none. Throws if the directory belongs to another manifest. One of the
/// two sweeps may have more values than the other.
std::optional<Manifest> manifest_in(const fs::path& directory, const Manifest& manifest) {
  const auto path = directory / "manifest.json";
  auto theirs = stored_manifest(directory);
  if (!theirs || digest(*theirs) == digest(manifest)) return theirs;
  const bool is_growth =
      contains_sweep(manifest, *theirs) || (contains_sweep(*theirs, manifest) && has_settings_of(*theirs, manifest));
  // Before the first record, the measures can still change.
  const bool is_begun = !names_in(directory / "records").empty() || !contains_sweep(manifest, *theirs);
  if (is_growth && (theirs->measures == manifest.measures || !is_begun)) return theirs;
  if (is_growth)
    throw InputError({path.string(), "/measure", "the directory has other measures than the manifest", "", "",
                      how_to_add(directory, *theirs, manifest)});
  refuse_other(directory.string(), "", differences(*theirs, manifest));
}

/// The manifest with the larger sweep. If the sweeps are the same, the new manifest.
const Manifest& larger(const std::optional<Manifest>& before, const Manifest& manifest) {
  return !before || contains_sweep(manifest, *before) ? manifest : *before;
}

/// Throws if a record belongs to another manifest. Checks the records that are not in the plan. If `all` is true,
/// checks all records. `all` is true if the directory has no manifest or a manifest with another digest.
void check_records(const fs::path& directory, const Manifest& manifest, bool all) {
  const auto names = names_in(directory / "records");
  if (names.empty()) return;
  const Plan plan(manifest);
  const auto ours = digest(manifest);
  for (const auto& name : names) {
    const bool planned = plan.place_of(name).has_value();
    if (planned && !all) continue;
    std::optional<RecordedReplicate> held;
    try {
      held = read_record(directory, name);
    } catch (const InputError&) {
      continue;
    }
    if (is_of(*held, plan) || is_superseded(*held, plan)) continue;
    if (planned) refuse_changed(directory, *held, plan);
    if (const auto& theirs = held->summary.manifest_digest; theirs != ours)
      refuse_other((directory / "records" / (name + ".json")).string(), digest_pointer, digests(theirs, ours));
  }
}

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

/// Number of replicates and stopping rule to be stored. A plan never becomes smaller: with fewer replicates than
/// before, the earlier number and stopping rule are kept.
Manifest grown(Manifest manifest, const std::optional<Manifest>& before) {
  if (!before) return manifest;
  auto& replicates = manifest.replicates;
  if (!replicates.goal && replicates.max <= before->replicates.max) replicates = before->replicates;
  replicates.max = std::max(replicates.max, before->replicates.max);
  return manifest;
}

/// Writes the manifest to the directory, and returns the manifest that is then stored. Throws if the directory belongs
/// to another manifest.
Manifest claim(const fs::path& directory, const Manifest& manifest) {
  const auto path = directory / "manifest.json";
  auto before = manifest_in(directory, manifest);
  if (!before && write_exclusively(path, sealed(to_json(manifest)))) return manifest;
  if (!before) before = manifest_in(directory, manifest);
  auto kept = grown(manifest, before);
  if (const auto& all = larger(before, manifest); &all != &manifest) {
    kept = *before;
    kept.replicates.max = std::max(kept.replicates.max, manifest.replicates.max);
  }
  const auto text = sealed(to_json(kept));
  if (text != read_file(path)) write_atomically(path, text);
  return kept;
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

void check_directory(const fs::path& directory, const Manifest& manifest) {
  refuse_links(directory);
  const auto before = manifest_in(directory, manifest);
  check_records(directory, larger(before, manifest), !before || digest(*before) != digest(manifest));
}

Store::Store(fs::path directory, const Manifest& manifest, Warn warn)
    : directory_(std::move(directory)),
      digest_(digest(manifest)),
      keep_path_(manifest.keep_path),
      warn_(std::move(warn)) {
  check_directory(directory_, manifest);
  make_own_folder(directory_);
  kept_ = claim(directory_, manifest);
  plan_ = std::make_shared<const Plan>(kept_);
  // Another process may have written its manifest in the meantime, so check again.
  manifest_in(directory_, manifest);
  for (const auto* folder : {"records", "packings", "checkpoints"}) make_own_folder(directory_ / folder);
  if (keep_path_) make_own_folder(directory_ / "paths");
  remove_outlived_checkpoints(directory_);
  check_writable(directory_ / "records");
}

fs::path Store::file(const char* folder, const ReplicateSpec& spec) const {
  return directory_ / folder / (replicate_name(spec) + ".json");
}

std::optional<RecordSummary> Store::recorded(const ReplicateSpec& spec) const {
  const auto path = record_path(spec).string();
  std::error_code error;
  if (fs::symlink_status(path, error).type() == fs::file_type::not_found) return std::nullopt;
  std::string theirs;
  try {
    auto held = read_record(directory_, replicate_name(spec));
    if (!is_of(held, *plan_)) {
      if (is_superseded(held, *plan_)) return std::nullopt;
      theirs = held.summary.manifest_digest;
    } else {
      check_spec(held, spec);
      check_companions(directory_, held, keep_path_);
      if (!lacks(held, kept_).empty())
        throw InputError({path, "/spec/measure",
                          "lacks measures that were added to the manifest later (\"isojam measure\" would add them in "
                          "less time)",
                          "", ""});
      return std::move(held.summary);
    }
  } catch (const InputError& damage) {
    warn_(fmt::format("{}; {}", problem_line(damage.details()), recomputed));
  }
  if (!theirs.empty()) refuse_other(path, digest_pointer, digests(theirs, digest_));
  return std::nullopt;
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
  if (!outcome.failure && keep_path_) write_atomically(path_path(outcome.spec), sealed(make_path(outcome, digest)));
  write_atomically(record_path(outcome.spec), sealed(record));
  // If the checkpoint cannot be removed, it does no harm: the record takes precedence, and the next run removes the
  // checkpoint.
  std::error_code ignored;
  fs::remove(checkpoint_path(outcome.spec), ignored);
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

Manifest extend_manifest(const fs::path& directory, const std::vector<Measure>& more) {
  const auto before = own_manifest(directory);
  auto manifest = with_measures(before, more);
  if (manifest.measures != before.measures) write_atomically(directory / "manifest.json", sealed(to_json(manifest)));
  return manifest;
}

void Store::write_tables(const Json& tables) const { write_atomically(tables_path(), sealed(tables)); }

void for_each_record(const fs::path& directory, const Warn& warn, const std::function<void(RecordedReplicate)>& use,
                     ReadRecord read) {
  for_each_record(directory, stored_manifest(directory), warn, use, read);
}

void for_each_record(const fs::path& directory, const std::optional<Manifest>& manifest, const Warn& warn,
                     const std::function<void(RecordedReplicate)>& use, ReadRecord read_one) {
  const auto names = names_in(directory / "records");
  if (names.empty()) throw_without_records(directory);
  const auto plan = manifest ? std::optional<Plan>(*manifest) : std::nullopt;
  const auto own = manifest ? digest(*manifest) : "";
  const auto measures = manifest ? to_json(*manifest).at("measure") : Json();
  struct Read {
    std::string name;
    std::optional<RecordedReplicate> held{};
    std::exception_ptr error{};
  };
  std::size_t count = 0;
  const auto next = [&](tbb::flow_control& control) {
    if (count == names.size()) control.stop();
    return count == names.size() ? std::string() : names[count++];
  };
  const auto read = [&](const std::string& name) {
    Read one{name};
    try {
      one.held = read_one(directory, name);
    } catch (const InputError&) {
      if (!plan || plan->place_of(name)) one.error = std::current_exception();
    } catch (...) {
      one.error = std::current_exception();
    }
    return one;
  };
  const auto file_of = [&](const std::string& name) { return (directory / "records" / (name + ".json")).string(); };
  const auto pass_on = [&](Read one) {
    // Thrown here instead of in `read`, so that the first error of the list is reported.
    if (one.error) std::rethrow_exception(one.error);
    if (!one.held) {
      warn(file_of(one.name) +
           ": is ignored, because the manifest has no such replicate; remove the file, or correct its name");
    } else if (plan && one.held->summary.manifest_digest != own && !is_of(*one.held, *plan)) {
      if (is_superseded(*one.held, *plan)) return;
      warn(fmt::format("{}: {}; the record is ignored", file_of(one.held->name), other_manifest));
    } else {
      // A record without a measure still counts for the quantities that it has.
      if (manifest) {
        one.held->summary.settings["measure"] = measures;
        one.held->summary.study = own;
      }
      use(*std::move(one.held));
    }
  };
  // At most four records for each thread are in memory.
  tbb::parallel_pipeline(4 * static_cast<std::size_t>(tbb::info::default_concurrency()),
                         tbb::make_filter<void, std::string>(tbb::filter_mode::serial_in_order, next) &
                             tbb::make_filter<std::string, Read>(tbb::filter_mode::parallel, read) &
                             tbb::make_filter<Read, void>(tbb::filter_mode::serial_in_order, pass_on));
}

}  // namespace isojam
