#include "tasks/records/recorded.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <iterator>
#include <system_error>

#include "tasks/io/file.hpp"
#include "tasks/io/input_error.hpp"
#include "tasks/io/resource_failure.hpp"
#include "tasks/io/sealed.hpp"
#include "tasks/records/earlier_record.hpp"
#include "tasks/records/record.hpp"
#include "tasks/records/state_file.hpp"
#include "tasks/records/store.hpp"
#include "tasks/records/texts.hpp"

namespace isojam {
namespace fs = std::filesystem;
namespace {

std::string file_in(const fs::path& directory, const std::string& folder, const std::string& name) {
  return (directory / folder / (name + ".json")).string();
}

std::string name_of(const RecordSummary& summary) {
  ReplicateSpec spec;
  spec.solid = summary.solid;
  spec.particles = summary.particles;
  spec.parameters = summary.parameters;
  spec.replicate = summary.replicate;
  return replicate_name(spec);
}

/// Identities that a packing or path of this record may state. If measures were added, the packings and paths still
/// state the digests from before.
std::vector<RecordIdentity> identities_of(const RecordedReplicate& replicate) {
  std::vector<RecordIdentity> identities{
      {replicate.name, replicate.summary.manifest_digest, replicate.summary.result_digest}};
  for (const auto& before : replicate.summary.before)
    identities.push_back({replicate.name, before.manifest_digest, before.result_digest});
  return identities;
}

}  // namespace

RecordedReplicate read_record(const fs::path& directory, const std::string& name) {
  const auto file = file_in(directory, "records", name);
  auto record = read_sealed(file);
  const auto digest = result_digest(record);
  const bool is_earlier = is_earlier_record(record);
  if (is_earlier) record = upgraded_record(std::move(record));
  auto summary = summarise_record(record, file);
  if (digest != summary.result_digest)
    throw InputError({file, "/result_digest", "the digest does not match the result", digest, ""});
  if (const auto own = name_of(summary); own != name)
    throw InputError({file, "/spec", "the file name does not match the replicate", own + ".json", ""});
  return {name, std::move(record), std::move(summary), is_earlier};
}

bool is_of(const RecordedReplicate& replicate, const Manifest& manifest) {
  return is_of_sweep(manifest, replicate.summary.measures, replicate.summary.manifest_digest);
}

std::vector<Measure> lacks(const RecordedReplicate& replicate, const Manifest& manifest) {
  const auto& has = replicate.summary.measures;
  std::vector<Measure> list;
  std::copy_if(manifest.measures.begin(), manifest.measures.end(), std::back_inserter(list),
               [&](Measure what) { return std::find(has.begin(), has.end(), what) == has.end(); });
  return list;
}

void check_spec(const RecordedReplicate& replicate, const ReplicateSpec& spec) {
  auto planned = spec;
  planned.measures = replicate.summary.measures;
  if (replicate.record.at("spec") != to_json(planned))
    throw InputError({replicate.name, "/spec", "differs from the plan of the manifest", "", ""});
}

void check_companions(const fs::path& directory, const RecordedReplicate& replicate, bool with_path) {
  if (replicate.summary.failed) return;
  check_state_file(file_in(directory, "packings", replicate.name), packing_schema, identities_of(replicate));
  if (with_path) check_state_file(file_in(directory, "paths", replicate.name), path_schema, identities_of(replicate));
}

Json read_state_file_of(const fs::path& directory, const RecordedReplicate& replicate, const std::string& folder) {
  return read_state_file(file_in(directory, folder, replicate.name), folder == "paths" ? path_schema : packing_schema,
                         identities_of(replicate));
}

bool is_resource_failure_record(const RecordedReplicate& replicate) {
  return replicate.summary.failed &&
         is_resource_failure_text(replicate.record.at("failure").at("why").get_ref<const std::string&>());
}

std::optional<Manifest> stored_manifest(const fs::path& directory) {
  try {
    return own_manifest(directory);
  } catch (const FileError& error) {
    if (error.reason() != FileError::Reason::missing) throw;
    return std::nullopt;
  }
}

void expect_directory(const fs::path& directory) {
  std::error_code error;
  const auto status = fs::status(directory, error);
  // If the directory has no read permission, the error is reported later, when the directory is read.
  if (status.type() == fs::file_type::not_found || (fs::exists(status) && !fs::is_directory(status)))
    throw FileError(fmt::format("{}: {}; {}", directory.string(), no_directory, how_to_get_results),
                    FileError::Reason::missing);
}

Manifest own_manifest(const fs::path& directory) {
  expect_directory(directory);
  const auto file = (directory / "manifest.json").string();
  try {
    return parse_manifest(read_file(file), file);
  } catch (const FileError& error) {
    if (error.reason() != FileError::Reason::missing) throw;
    if (names_in(directory / "records").empty()) throw_without_records(directory);
    throw FileError(file + ": the file is missing; run the manifest again in this directory", error.reason());
  }
}

std::vector<std::string> names_in(const fs::path& folder) {
  std::vector<std::string> names;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder, error)) {
    const auto name = entry.path().filename().string();
    if (name.front() != '.' && entry.path().extension() == ".json") names.push_back(entry.path().stem().string());
  }
  if (error && error != std::errc::no_such_file_or_directory) {
    errno = error.value();
    throw FileError::of_errno(folder, "cannot be listed");
  }
  std::sort(names.begin(), names.end());
  return names;
}

}  // namespace isojam
