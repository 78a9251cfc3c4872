#pragma once

#include <array>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "engine/names/enum_names.hpp"
#include "tasks/export/frame.hpp"

namespace isojam {

enum class ExportFormat { gsd, vtp, xyz };
template <>
inline constexpr std::array enum_names<ExportFormat>{
    EnumName{ExportFormat::gsd, "gsd"}, EnumName{ExportFormat::vtp, "vtp"}, EnumName{ExportFormat::xyz, "xyz"}};

struct ExportedFile {
  std::filesystem::path path;
  std::string bytes;
};

/// The files of one replicate in the order of writing, so that each refers only to earlier ones. gsd: `output`. xyz:
/// `output`, and the solid beside it as .obj. vtp: `output`, or for a `collection` files _0000.vtp, _0001.vtp, … for
/// the frames and a .pvd file, all named after `output` without its .vtp or .pvd. The time of a frame is its Δφ, or its
/// number if it has none. Frames with a network have a second set of files with -contacts at the end of their names.
/// Throws FileError if two files would have the same path.
std::vector<ExportedFile> exported_files(std::span<const ExportFrame> frames, ExportFormat format, bool collection,
                                         const std::filesystem::path& output);

}  // namespace isojam
