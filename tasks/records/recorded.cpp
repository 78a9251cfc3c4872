#include "tasks/records/recorded.hpp"

#include <fmt/format.h>
#include <tbb/info.h>
#include <tbb/parallel_pipeline.h>

#include <algorithm>
#include <charconv>
#include <exception>
#include <system_error>

#include "tasks/io/file.hpp"
#include "tasks/io/input_error.hpp"
#include "tasks/io/place.hpp"
#include "tasks/io/sealed.hpp"
#include "tasks/packings/packing_json.hpp"
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
      {replicate.name, replicate.document.provenance.spec_digest, replicate.summary.result_digest}};
  for (const auto& before : replicate.summary.before)
    identities.push_back({replicate.name, before.spec_digest, before.result_digest});
  return identities;
}

/// Returns the result of `read`. An error of a record, packing or path gets the same remedy, unless it states its own.
template <class Read>
auto with_remedy(const Read& read) {
  try {
    return read();
  } catch (const InputError& error) {
    auto details = error.details();
    details.suggestion.clear();
    if (details.remedy.empty()) details.remedy = how_to_recompute;
    throw InputError(std::move(details));
  }
}

/// Returns the result of `read`. A missing file is an error of the results, because a list or a record names it.
template <class Read>
auto expect_present(const std::string& file, const Read& read) {
  try {
    return read();
  } catch (const FileError& error) {
    if (error.reason() != FileError::Reason::missing) throw;
    throw InputError({file, "", "the file is missing", "", ""});
  }
}

/// Passes the path of a packing or path file, its schema and the identities that it may state to `read`.
template <class Read>
auto with_state_file(const fs::path& directory, const RecordedReplicate& replicate, const std::string& folder,
                     const Read& read) {
  const auto file = file_in(directory, folder, replicate.name);
  return with_remedy([&] {
    return expect_present(
        file, [&] { return read(file, folder == "paths" ? path_schema : packing_schema, identities_of(replicate)); });
  });
}

RecordedReplicate recorded(Json json, const std::string& file, const std::string& name) {
  auto document = read_record_document(json, file);
  auto summary = summarise_record(document, json, file);
  if (const auto own = name_of(summary); own != name)
    throw InputError(
        {file, "/spec", fmt::format("the file name does not match the replicate {}", own), own + ".json", ""});
  return {name, std::move(json), std::move(document), std::move(summary)};
}

}  // namespace

RecordedReplicate read_record(const fs::path& directory, const std::string& name,
                              const std::optional<Abridgement>& kept) {
  const auto file = file_in(directory, "records", name);
  return with_remedy([&] {
    const auto text = expect_present(file, [&] { return read_result(file); });
    check_seal(text, file);
    auto replicate = recorded(parsed_document(kept ? abridged(text, *kept) : text, file), file, name);
    const auto& own = replicate.summary.result_digest;
    if (const auto digest = kept ? own : result_digest(replicate.record); digest != own)
      throw InputError(
          {file, "/result_digest", "the record was changed: its result does not match its digest", digest, ""});
    // Nothing was left out of a record that another program wrote in one line.
    constexpr std::string_view nearest = "\n  \"nearest\": ";
    const auto at = text.find(nearest);
    std::size_t index = 0;
    if (kept && kept->states == States::nearest && at != std::string::npos &&
        std::from_chars(&text[at + nearest.size()], &text.back(), index).ec == std::errc())
      replicate.nearest = index;
    return replicate;
  });
}

void read_in_order(const std::vector<std::string>& names,
                   const std::function<std::function<void()>(const std::string&)>& read) {
  std::size_t next = 0;
  const auto give = [&](tbb::flow_control& control) {
    if (next == names.size()) control.stop();
    return next++;
  };
  // Indices go through the pipeline: what an exception leaves in it is not freed.
  std::vector<std::function<void()>> uses(names.size());
  const auto read_one = [&](std::size_t k) {
    try {
      uses[k] = read(names[k]);
    } catch (...) {
      // Thrown in turn, so that the first error of the list is reported.
      uses[k] = [error = std::current_exception()] { std::rethrow_exception(error); };
    }
    return k;
  };
  const auto use = [&](std::size_t k) { uses[k](), uses[k] = nullptr; };
  // At most four records for each thread are in memory.
  tbb::parallel_pipeline(4 * static_cast<std::size_t>(tbb::info::default_concurrency()),
                         tbb::make_filter<void, std::size_t>(tbb::filter_mode::serial_in_order, give) &
                             tbb::make_filter<std::size_t, std::size_t>(tbb::filter_mode::parallel, read_one) &
                             tbb::make_filter<std::size_t, void>(tbb::filter_mode::serial_in_order, use));
}

std::vector<Measure> lacks(const RecordedReplicate& replicate, const std::vector<Measure>& measures) {
  const auto& has = replicate.summary.measures;
  auto list = measures;
  std::erase_if(list, [&](Measure what) { return std::find(has.begin(), has.end(), what) != has.end(); });
  return list;
}

void check_companions(const fs::path& directory, const RecordedReplicate& replicate, bool with_path) {
  if (replicate.summary.failed) return;
  with_state_file(directory, replicate, "packings", check_state_file);
  if (with_path) with_state_file(directory, replicate, "paths", check_state_file);
}

Json read_state_file_of(const fs::path& directory, const RecordedReplicate& replicate, const std::string& folder) {
  return with_state_file(directory, replicate, folder, read_state_file);
}

std::optional<Packing> read_nearest_packing(const fs::path& directory, const RecordedReplicate& replicate) {
  const auto file = file_in(directory, "packings", replicate.name);
  std::error_code error;
  if (!fs::exists(file, error)) return std::nullopt;
  const auto json = read_state_file_of(directory, replicate, "packings");
  return read_packing({json, file});
}

std::optional<Manifest> stored_manifest(const fs::path& directory) {
  const auto file = (directory / "manifest.json").string();
  try {
    return parse_manifest(read_file(file), file);
  } catch (const InputError& error) {
    const auto& pointer = error.details().pointer;
    if (pointer.empty() || pointer == "/checksum") throw;
    // The file has its checksum, so another version wrote this value.
    throw InputError({file, pointer, "the results were written by another version of isojam, such as 0.1.0", "", "",
                      "run their manifest again in another directory"});
  } catch (const FileError& error) {
    if (error.reason() != FileError::Reason::missing) throw;
    return std::nullopt;
  }
}

void expect_directory(const fs::path& directory) {
  std::error_code error;
  const auto status = fs::status(directory, error);
  // If the directory has no read permission, the error is reported later, when the directory is read.
  const bool is_missing = status.type() == fs::file_type::not_found;
  if (is_missing || (fs::exists(status) && !fs::is_directory(status)))
    throw FileError(fmt::format("{}: {}; {}", directory.string(), is_missing ? no_directory : "is not a directory",
                                how_to_get_results),
                    FileError::Reason::missing);
}

Manifest own_manifest(const fs::path& directory) {
  expect_directory(directory);
  if (auto manifest = stored_manifest(directory)) return std::move(*manifest);
  if (names_in(directory / "records").empty()) throw_without_records(directory);
  throw InputError({(directory / "manifest.json").string(), "", "the file is missing", "", "",
                    "run the manifest again in this directory"});
}

std::vector<std::string> names_in(const fs::path& folder) {
  std::vector<std::string> names;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder, error)) {
    const auto name = entry.path().filename().string();
    if (name.front() != '.' && entry.path().extension() == ".json") names.push_back(entry.path().stem().string());
  }
  if (error == std::errc::not_a_directory) {
    expect_directory(folder.parent_path());
    throw FileError(
        fmt::format("{}: is a file instead of a folder; remove it, or {}", folder.string(), choose_another_directory),
        FileError::Reason::missing);
  }
  if (error && error != std::errc::no_such_file_or_directory)
    throw FileError::of_error(folder, "cannot be listed", error);
  std::sort(names.begin(), names.end());
  return names;
}

}  // namespace isojam
