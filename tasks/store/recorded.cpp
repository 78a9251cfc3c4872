#include "tasks/store/recorded.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <iterator>
#include <system_error>

#include "tasks/json/input_error.hpp"
#include "tasks/json/sealed.hpp"
#include "tasks/replicate/companion.hpp"
#include "tasks/replicate/record.hpp"
#include "tasks/system/file.hpp"
#include "tasks/system/shortage.hpp"

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

/// Packings and paths stay as they are when something is added to their record.
std::vector<Owner> owners_of(const RecordedReplicate& replicate) {
  std::vector<Owner> owners{{replicate.name, replicate.summary.manifest_digest, replicate.summary.result_digest}};
  for (const auto& before : replicate.summary.before)
    owners.push_back({replicate.name, before.manifest_digest, before.result_digest});
  return owners;
}

}  // namespace

RecordedReplicate read_record(const fs::path& directory, const std::string& name) {
  const auto file = file_in(directory, "records", name);
  auto record = read_sealed(file);
  auto summary = summarise_record(record, file);
  if (const auto digest = result_digest(record); digest != summary.result_digest)
    throw InputError({file, "/result_digest", "the result has another digest", digest, ""});
  if (const auto own = name_of(summary); own != name)
    throw InputError({file, "/spec", "is not the replicate that the name of the file says", own, ""});
  return {name, std::move(record), std::move(summary)};
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
    throw InputError({replicate.name, "/spec", "is not what its manifest plans", "", ""});
}

void check_companions(const fs::path& directory, const RecordedReplicate& replicate, bool with_path) {
  if (replicate.summary.failed) return;
  check_companion(file_in(directory, "packings", replicate.name), packing_schema, owners_of(replicate));
  if (with_path) check_companion(file_in(directory, "paths", replicate.name), path_schema, owners_of(replicate));
}

Json read_companion_of(const fs::path& directory, const RecordedReplicate& replicate, const std::string& folder) {
  return read_companion(file_in(directory, folder, replicate.name), folder == "paths" ? path_schema : packing_schema,
                        owners_of(replicate));
}

bool failed_for_want(const RecordedReplicate& replicate) {
  return replicate.summary.failed &&
         is_shortage_text(replicate.record.at("failure").at("why").get_ref<const std::string&>());
}

std::optional<Manifest> stored_manifest(const fs::path& directory) {
  try {
    return own_manifest(directory);
  } catch (const FileError& error) {
    if (error.reason() != FileError::Reason::missing) throw;
    return std::nullopt;
  }
}

Manifest own_manifest(const fs::path& directory) {
  const auto file = (directory / "manifest.json").string();
  return parse_manifest(read_file(file), file);
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
