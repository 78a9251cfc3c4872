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

/// The files of one replicate in the order in which they are to be written, so that each refers to earlier ones only:
/// gsd: `output`; xyz: `output`, and the solid beside it as .obj; vtp: `output`, or, if `collection`, one _0000.vtp,
/// _0001.vtp, … for each frame and a .pvd, all named after `output` without its .vtp or .pvd, with Δφ (the number of
/// the frame where a frame has none) for time, and of frames with a network the same again with -contacts at the end of
/// their names. Throws FileError if two of them would have the same path.
std::vector<ExportedFile> exported_files(std::span<const ExportFrame> frames, ExportFormat format, bool collection,
                                         const std::filesystem::path& output);

}  // namespace isojam
