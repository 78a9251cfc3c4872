#include "tasks/export/exported_files.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <string>
#include <utility>

#include "tasks/export/formats.hpp"
#include "tasks/system/file.hpp"

namespace isojam {
namespace fs = std::filesystem;
namespace {

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
  std::vector<ExportedFile> files{{output, xyz_file(frames)}};
  const auto& packing = frames.front().packing;
  if (packing.solids.is_uniform()) {
    files.push_back({solid, obj_file(packing.solids.only())});
    return files;
  }
  // Species are told by shape; the size of a particle stands beside its name.
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

}  // namespace isojam
