#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <optional>
#include <system_error>

#include "tasks/commands/command.hpp"
#include "tasks/export/exported_files.hpp"
#include "tasks/json/input_error.hpp"
#include "tasks/json/place.hpp"
#include "tasks/packings/packing_json.hpp"
#include "tasks/store/store.hpp"
#include "tasks/system/atomic_file.hpp"
#include "tasks/system/file.hpp"
#include "tasks/system/standard_streams.hpp"

namespace isojam {
namespace fs = std::filesystem;
namespace {

struct Arguments {
  std::string directory;  ///< of results
  std::string replicate;  ///< its name, or "all"
  ExportFormat format = ExportFormat::gsd;
  std::string output;  ///< file; of "all" the directory, created if it is missing, that takes <name>.<format>
  bool path = false;   ///< every state of the expansion instead of the one nearest jamming
};

constexpr std::string_view every_replicate = "all";

std::string_view extension_of(ExportFormat format, bool collection) {
  switch (format) {
    case ExportFormat::gsd: return ".gsd";
    case ExportFormat::xyz: return ".xyz";
    case ExportFormat::vtp: break;
  }
  return collection ? ".pvd" : ".vtp";
}

fs::path file_of(const Arguments& arguments, const char* folder, const std::string& name) {
  return fs::path(arguments.directory) / folder / (name + ".json");
}

/// Only names of records that are there ever become part of a path.
std::vector<std::string> chosen_names(const Arguments& arguments) {
  auto names = names_in(fs::path(arguments.directory) / "records");
  if (names.empty()) throw_without_records(arguments.directory);
  if (arguments.replicate == every_replicate) return names;
  if (std::find(names.begin(), names.end(), arguments.replicate) != names.end()) return {arguments.replicate};
  const std::vector<std::string_view> candidates(names.begin(), names.end());
  const auto near = nearest_name(arguments.replicate, candidates);
  throw FileError(fmt::format("{}: holds no replicate \"{}\"{}", arguments.directory, arguments.replicate,
                              near.empty() ? fmt::format("; there are {}, \"{}\" the first", names.size(), names[0])
                                           : fmt::format("; did you mean \"{}\"?", near)));
}

std::optional<double> distance_of(const JsonPlace& state) {
  const auto place = state.at("delta_phi");
  if (place.value().is_null()) return std::nullopt;
  return place.number({-1, 1});
}

/// nullopt if the replicate did not fail.
std::optional<std::string> failure_text(const JsonPlace& record) {
  if (record.at("status").choice(std::array<std::string_view, 2>{"done", "failed"}) == 0) return std::nullopt;
  const auto failure = record.at("failure");
  return fmt::format("failed in {}: {}", failure.at("where").text(), failure.at("why").text());
}

ExportFrame read_nearest(const Arguments& arguments, const RecordedReplicate& held, const JsonPlace& record) {
  const auto json = read_companion_of(arguments.directory, held, "packings");
  const JsonPlace packing(json, file_of(arguments, "packings", held.name).string());
  return make_frame(read_packing(packing), distance_of(record.at("nearest")));
}

std::vector<ExportFrame> read_path(const Arguments& arguments, const RecordedReplicate& held) {
  const auto file = file_of(arguments, "paths", held.name);
  std::error_code error;
  if (!fs::exists(file, error)) {
    throw FileError(fmt::format("{}: is not there: expansions are kept only if the manifest says \"keep_path\": true",
                                file.string()));
  }
  const auto json = read_companion_of(arguments.directory, held, "paths");
  const auto states = JsonPlace(json, file.string()).at("states");
  const auto count = states.expect_list("a list of states");
  if (count == 0) states.refuse("the expansion has no states");
  std::vector<ExportFrame> frames;
  for (std::size_t k = 0; k < count; ++k) {
    const auto state = states.at(k);
    frames.push_back(make_frame(read_packing(state), distance_of(state)));
    const auto &first = frames.front().packing, &last = frames.back().packing;
    if (!(last.solids == first.solids) || last.size() != first.size())
      state.refuse("not a state of the same particles");
  }
  return frames;
}

/// A failed replicate that was not asked for by name gives a warning and no file. `own` is the digest of the
/// directory's manifest, if it has one. A stream gets the file that was named and not those that stand beside it.
void export_replicate(const Arguments& arguments, const std::optional<std::string>& own, const std::string& name,
                      const fs::path& output, Console& console) {
  const auto held = read_record(arguments.directory, name);
  if (own && held.summary.manifest_digest != *own)
    throw InputError({file_of(arguments, "records", name).string(), "/provenance/manifest_digest",
                      "belongs to another manifest than the directory", "", ""});
  const JsonPlace record(held.record, file_of(arguments, "records", name).string());
  if (const auto failure = failure_text(record)) {
    const auto message = fmt::format("{} {}; it has no packing", name, *failure);
    if (arguments.replicate != every_replicate) throw FileError(message);
    console.warn(message);
    return;
  }
  const auto frames = arguments.path ? read_path(arguments, held) : std::vector{read_nearest(arguments, held, record)};
  const auto undecided = std::count_if(frames.begin(), frames.end(), [](const ExportFrame& frame) {
    return frame.cluster.front() == ExportFrame::undecided_cluster;
  });
  if (undecided > 0) {
    console.warn(fmt::format("{}: classes of contacts, and so clusters, are undecided in {} of {} states", name,
                             undecided, frames.size()));
  }
  auto files = exported_files(frames, arguments.format, arguments.path, output);
  if (is_stream(output)) std::erase_if(files, [&](const ExportedFile& file) { return file.path != output; });
  if (files.empty()) throw FileError(fmt::format("{}: takes one file, and this makes several", output.string()));
  for (const auto& exported : files) {
    write_output(exported.path, exported.bytes);
    print(exported.path.string() + "\n");
  }
}

/// Writes and lists on stdout what other programs open. A failed replicate has no packing: an error, or, of "all", a
/// warning.
ExitCode export_packings(const Arguments& arguments, Console& console) {
  const auto names = chosen_names(arguments);
  const auto manifest = stored_manifest(arguments.directory);
  const auto own = manifest ? std::optional(digest(*manifest)) : std::nullopt;
  if (arguments.replicate != every_replicate) {
    export_replicate(arguments, own, names.front(), arguments.output, console);
    return ExitCode::done;
  }
  std::error_code error;
  fs::create_directories(arguments.output, error);
  if (error) throw FileError(fmt::format("{}: cannot be created: {}", arguments.output, error.message()));
  for (const auto& name : names) {
    const auto file = name + std::string(extension_of(arguments.format, arguments.path));
    export_replicate(arguments, own, name, fs::path(arguments.output) / file, console);
  }
  return ExitCode::done;
}

}  // namespace

void add_export(CLI::App& app, Session& session) {
  Arguments* arguments = nullptr;
  auto options = add_command(app, session, "export", "Write packings for HOOMD-blue and OVITO, ParaView, or as text",
                             export_packings, arguments);
  options.results_directory(arguments->directory);
  options.text("replicate", arguments->replicate, "Name of a replicate, as its record's file has it, or all",
               "REPLICATE", Options::Need::required);
  options.choice("--format", arguments->format, "Format of the files", Options::Need::required);
  options.text("-o,--output", arguments->output, "File to write; of all replicates, the directory for them", "FILE",
               Options::Need::required);
  options.flag("--path", arguments->path, "Every state of the expansion (of manifests with keep_path)");
}

}  // namespace isojam
