#include "tasks/export/export_command.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <optional>
#include <system_error>

#include "tasks/atomic_file.hpp"
#include "tasks/export/formats.hpp"
#include "tasks/input_error.hpp"
#include "tasks/json_place.hpp"
#include "tasks/packing_json.hpp"
#include "tasks/sealed_json.hpp"
#include "tasks/store.hpp"

namespace isojam {
namespace fs = std::filesystem;
namespace {

constexpr std::string_view every_replicate = "all";

std::string_view extension_of(ExportFormat format, bool collection) {
  switch (format) {
    case ExportFormat::gsd: return ".gsd";
    case ExportFormat::xyz: return ".xyz";
    case ExportFormat::vtp: break;
  }
  return collection ? ".pvd" : ".vtp";
}

fs::path file_of(const ExportCommand& command, const char* folder, const std::string& name) {
  return fs::path(command.directory) / folder / (name + ".json");
}

/// Only names of records that are there ever become part of a path.
std::vector<std::string> chosen_names(const ExportCommand& command) {
  const auto names = names_in(fs::path(command.directory) / "records");
  if (names.empty()) throw FileError(fmt::format("{}: holds no records", command.directory));
  if (command.replicate == every_replicate) return names;
  if (std::find(names.begin(), names.end(), command.replicate) != names.end()) return {command.replicate};
  const std::vector<std::string_view> candidates(names.begin(), names.end());
  const auto near = nearest_name(command.replicate, candidates);
  throw FileError(fmt::format("{}: holds no replicate \"{}\"{}", command.directory, command.replicate,
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

ExportFrame read_nearest(const ExportCommand& command, const std::string& name, const JsonPlace& record) {
  const auto file = file_of(command, "packings", name).string();
  const auto json = read_sealed(file);
  return make_frame(read_packing(JsonPlace(json, file)), distance_of(record.at("nearest")));
}

std::vector<ExportFrame> read_path(const ExportCommand& command, const std::string& name) {
  const auto file = file_of(command, "paths", name);
  std::error_code error;
  if (!fs::exists(file, error)) {
    throw FileError(fmt::format("{}: is not there: expansions are kept only if the manifest says \"keep_path\": true",
                                file.string()));
  }
  const auto json = read_sealed(file.string());
  const auto states = JsonPlace(json, file.string()).at("states");
  const auto count = states.expect_list("a list of states");
  if (count == 0) states.refuse("the expansion has no states");
  std::vector<ExportFrame> frames;
  for (std::size_t k = 0; k < count; ++k) {
    const auto state = states.at(k);
    frames.push_back(make_frame(read_packing(state), distance_of(state)));
    const auto &first = frames.front().packing, &last = frames.back().packing;
    if (last.solid != first.solid || last.size() != first.size()) state.refuse("not a state of the same particles");
  }
  return frames;
}

/// A failed replicate that was not asked for by name gives a warning and no file.
void export_replicate(const ExportCommand& command, const std::string& name, const fs::path& output, Console& console) {
  const auto file = file_of(command, "records", name).string();
  const auto json = read_sealed(file);
  const JsonPlace record(json, file);
  if (const auto failure = failure_text(record)) {
    const auto message = fmt::format("{} {}; it has no packing", name, *failure);
    if (command.replicate != every_replicate) throw FileError(message);
    console.warn(message);
    return;
  }
  const auto frames = command.path ? read_path(command, name) : std::vector{read_nearest(command, name, record)};
  const auto undecided = std::count_if(frames.begin(), frames.end(), [](const ExportFrame& frame) {
    return frame.cluster.front() == ExportFrame::undecided_cluster;
  });
  if (undecided > 0) {
    console.warn(fmt::format("{}: classes of contacts, and so clusters, are undecided in {} of {} states", name,
                             undecided, frames.size()));
  }
  for (const auto& exported : exported_files(frames, command.format, command.path, output)) {
    write_atomically(exported.path, exported.bytes);
    fmt::print("{}\n", exported.path.string());
  }
}

std::vector<ExportedFile> collection_files(std::span<const ExportFrame> frames, fs::path output) {
  if (output.extension() == ".vtp" || output.extension() == ".pvd") output.replace_extension();
  const bool timed = std::all_of(frames.begin(), frames.end(), [](const auto& frame) { return frame.delta_phi; });
  std::vector<ExportedFile> files;
  std::vector<TimedFile> collection;
  for (std::size_t k = 0; k < frames.size(); ++k) {
    auto path = output;
    path += fmt::format("_{:04}.vtp", k);
    collection.push_back({path.filename().string(), timed ? *frames[k].delta_phi : static_cast<double>(k)});
    files.push_back({std::move(path), vtp_file(frames[k])});
  }
  files.push_back({output += ".pvd", pvd_file(collection)});
  return files;
}

std::vector<ExportedFile> xyz_files(std::span<const ExportFrame> frames, const fs::path& output) {
  auto solid = output;
  solid.replace_extension(".obj");
  if (solid == output) {
    throw FileError(fmt::format("{}: the solid goes there; choose another extension", output.string()));
  }
  return {{output, xyz_file(frames)}, {solid, obj_file(*frames.front().packing.solid)}};
}

}  // namespace

std::vector<ExportedFile> exported_files(std::span<const ExportFrame> frames, ExportFormat format, bool collection,
                                         const fs::path& output) {
  check_frames(frames);
  switch (format) {
    case ExportFormat::gsd: return {{output, gsd_file(frames)}};
    case ExportFormat::xyz: return xyz_files(frames, output);
    case ExportFormat::vtp: break;
  }
  if (collection) return collection_files(frames, output);
  return {{output, vtp_file(frames.front())}};
}

ExitCode export_packings(const ExportCommand& command, Console& console) {
  const auto names = chosen_names(command);
  if (command.replicate != every_replicate) {
    export_replicate(command, names.front(), command.output, console);
    return ExitCode::done;
  }
  std::error_code error;
  fs::create_directories(command.output, error);
  if (error) throw FileError(fmt::format("{}: cannot be created: {}", command.output, error.message()));
  for (const auto& name : names) {
    const auto file = name + std::string(extension_of(command.format, command.path));
    export_replicate(command, name, fs::path(command.output) / file, console);
  }
  return ExitCode::done;
}

}  // namespace isojam
