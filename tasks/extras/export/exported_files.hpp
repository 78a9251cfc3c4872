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

/// Makes the files of one replicate, in the order in which they must be written: a file refers only to earlier ones.
/// - gsd: the file `output`.
/// - xyz: the file `output`, and the shape of each solid as an .obj file in the same folder. If particles differ in
///   solid or size, the name of the solid is part of the name of its .obj file.
/// - vtp without `collection`: the file `output`.
/// - vtp with `collection`: one file for each frame, with names that end in _0000.vtp, _0001.vtp, …, and a .pvd file.
///   The names begin with `output` without the extension .vtp or .pvd. The time of a frame is its Δφ. If any frame has
///   no Δφ, the time of every frame is its index.
///
/// For vtp, frames with a contact network have a second set of files, whose names end in -contacts before the
/// extension. Throws UsageError if `output` for xyz has the extension .obj.
std::vector<ExportedFile> exported_files(std::span<const ExportFrame> frames, ExportFormat format, bool collection,
                                         const std::filesystem::path& output);

}  // namespace isojam
