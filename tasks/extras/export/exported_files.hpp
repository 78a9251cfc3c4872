#pragma once

#include <array>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "engine/names/enum_names.hpp"
#include "tasks/extras/export/frame.hpp"

namespace isojam {

enum class ExportFormat { gsd, vtp, xyz };
template <>
inline constexpr std::array enum_names<ExportFormat>{
    EnumName{ExportFormat::gsd, "gsd"}, EnumName{ExportFormat::vtp, "vtp"}, EnumName{ExportFormat::xyz, "xyz"}};

struct ExportedFile {
  std::filesystem::path path;
  std::string bytes;
};

/// Makes the files of one replicate, in the order in which they are written, so that a file refers only to earlier
/// ones. gsd: the file `output`. xyz: the file `output`, and the solid as an .obj file in the same folder. vtp: the
/// file `output`; for a `collection`, files _0000.vtp, _0001.vtp, … for the frames and a .pvd file, whose names begin
/// with `output` without its extension. The time of a frame is its Δφ, or its number if it has no Δφ. If frames have a
/// contact network, there is a second set of files whose names end in -contacts. Throws FileError if two files would
/// have the same path.
std::vector<ExportedFile> exported_files(std::span<const ExportFrame> frames, ExportFormat format, bool collection,
                                         const std::filesystem::path& output);

}  // namespace isojam
