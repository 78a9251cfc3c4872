#pragma once

#include <array>
#include <string>
#include <vector>

#include "engine/names/enum_names.hpp"
#include "tasks/json/place.hpp"
#include "tasks/store/recorded.hpp"
#include "tasks/system/console.hpp"
#include "tasks/system/exit_codes.hpp"

namespace isojam {

/// Kinds of export: packings in formats of other programs, or tables whose rows are contacts or records.
enum class Exported { gsd, vtp, xyz, contacts, replicates, states };
template <>
inline constexpr std::array enum_names<Exported>{EnumName{Exported::gsd, "gsd"},
                                                 EnumName{Exported::vtp, "vtp"},
                                                 EnumName{Exported::xyz, "xyz"},
                                                 EnumName{Exported::contacts, "contacts"},
                                                 EnumName{Exported::replicates, "replicates"},
                                                 EnumName{Exported::states, "states"}};

struct ExportArguments {
  std::string directory;  ///< results directory
  std::string replicate;  ///< its name, or "all"
  Exported what = Exported::gsd;
  /// Output path. For packings of "all": the directory for <name>.<format>, created if it is missing. For tables: a
  /// file, or empty for stdout.
  std::string output;
  bool path = false;      ///< every state of the expansion instead of the one nearest jamming
  bool contacts = false;  ///< also export the contact networks of packings

  bool all() const { return replicate == "all"; }
};

/// Names of the requested replicates. Only names of existing records ever become part of a path.
std::vector<std::string> chosen_names(const ExportArguments& arguments);

/// Reads a record and checks that it belongs to this manifest, if the directory has one. Throws as read_record does.
RecordedReplicate own_record(const ExportArguments& arguments, const std::optional<Manifest>& manifest,
                             const std::string& name);

/// Returns false if the replicate failed and so has no packing. This is an error if it was requested by name, and a
/// warning otherwise.
bool has_packing(const ExportArguments& arguments, const RecordedReplicate& held, Console& console);

/// Writes files for other programs and lists them on stdout.
ExitCode export_packings(const ExportArguments& arguments, Console& console);

/// Writes a table as CSV, or as JSON lines if the file name ends in .jsonl.
ExitCode export_rows(const ExportArguments& arguments, Console& console);

}  // namespace isojam
