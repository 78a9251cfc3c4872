#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "tasks/console.hpp"
#include "tasks/exit_codes.hpp"
#include "tasks/export/frame.hpp"

namespace isojam {

enum class ExportFormat { gsd, vtp, xyz };

struct ExportCommand {
  std::string directory;  ///< of results
  std::string replicate;  ///< its name, or "all"
  ExportFormat format = ExportFormat::gsd;
  std::string output;  ///< file; of "all" the directory, created if it is missing, that takes <name>.<format>
  bool path = false;   ///< every state of the expansion instead of the one nearest jamming
};

/// Writes and lists on stdout what other programs open. A failed replicate has no packing: an error, or, of "all", a
/// warning. Throws FileError if the directory holds no such replicate or not its expansion, or nothing can be written;
/// InputError for a damaged record or packing.
ExitCode export_packings(const ExportCommand& command, Console& console);

struct ExportedFile {
  std::filesystem::path path;
  std::string bytes;
};

/// The files of one replicate in the order in which they are to be written, so that each refers to earlier ones only:
/// gsd: `output`; xyz: `output`, and the solid beside it as .obj; vtp: `output`, or, if `collection`, one _0000.vtp,
/// _0001.vtp, … for each frame and a .pvd, all named after `output` without its .vtp or .pvd, with Δφ (the number of
/// the frame where a frame has none) for time. Throws FileError if two of them would have the same path.
std::vector<ExportedFile> exported_files(std::span<const ExportFrame> frames, ExportFormat format, bool collection,
                                         const std::filesystem::path& output);

}  // namespace isojam
