#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <string>
#include <utility>

#include "tasks/extras/export/formats.hpp"
#include "tasks/io/usage_error.hpp"

namespace isojam {
namespace fs = std::filesystem;
namespace {

/// Adds one file for each state, and the .pvd file that lists them.
template <class MakeFile>
void append_collection(std::span<const ExportFrame> frames, const fs::path& stem, std::string_view suffix,
                       const MakeFile& make, std::vector<ExportedFile>& files) {
  const bool timed = std::all_of(frames.begin(), frames.end(), [](const auto& frame) { return frame.delta_phi; });
  std::vector<TimedFile> collection;
  for (std::size_t k = 0; k < frames.size(); ++k) {
    auto path = stem;
    path += fmt::format("_{:04}{}.vtp", k, suffix);
    collection.push_back({path.filename().string(), timed ? *frames[k].delta_phi : static_cast<double>(k)});
    files.push_back({std::move(path), make(frames[k])});
  }
  auto path = stem;
  files.push_back({path += fmt::format("{}.pvd", suffix), pvd_file(collection)});
}

constexpr std::string_view network_suffix = "-contacts";

std::vector<ExportedFile> vtp_files(std::span<const ExportFrame> frames, bool collection, const fs::path& output) {
  std::vector<ExportedFile> files;
  const bool with_network = frames.front().network.has_value();
  auto stem = output;
  if (output.extension() == ".vtp" || output.extension() == ".pvd") stem.replace_extension();
  if (collection) {
    append_collection(frames, stem, "", vtp_file, files);
    if (with_network) append_collection(frames, stem, network_suffix, vtp_lines_file, files);
    return files;
  }
  files.push_back({output, vtp_file(frames.front())});
  if (with_network) files.push_back({stem += fmt::format("{}.vtp", network_suffix), vtp_lines_file(frames.front())});
  return files;
}

std::vector<ExportedFile> xyz_files(std::span<const ExportFrame> frames, const fs::path& output) {
  auto solid = output;
  solid.replace_extension(".obj");
  if (solid == output) {
    throw UsageError(
        fmt::format("{}: this name is reserved for the shape of the solid; choose another extension", output.string()));
  }
  std::vector<ExportedFile> files{{output, xyz_file(frames)}};
  const auto& packing = frames.front().packing;
  if (packing.solids.is_uniform()) {
    files.push_back({solid, obj_file(packing.solids.only())});
    return files;
  }
  // Each kind of solid has one shape. The sizes of the particles are a separate column.
  std::map<std::string, const ConvexSolid*> shapes;
  for (std::size_t i = 0; i < packing.poses.size(); ++i)
    shapes.emplace(packing.solids.unit(i).name(), &packing.solids.unit(i));
  for (const auto& [name, shape] : shapes) {
    auto path = solid;
    path.replace_filename(fmt::format("{}-{}.obj", solid.stem().string(), name));
    files.push_back({path, obj_file(*shape)});
  }
  return files;
}

}  // namespace

std::vector<ExportedFile> exported_files(std::span<const ExportFrame> frames, Exported format, bool collection,
                                         const fs::path& output) {
  check_frames(frames);
  switch (format) {
    case Exported::gsd: return {{output, gsd_file(frames)}};
    case Exported::vtp: return vtp_files(frames, collection, output);
    case Exported::xyz: return xyz_files(frames, output);
    default: return {};
  }
}

}  // namespace isojam
