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

/// What can be exported: packings in formats of other programs, or tables whose rows are contacts or records.
enum class Exported { gsd, vtp, xyz, contacts, replicates, states };
template <>
inline constexpr std::array enum_names<Exported>{EnumName{Exported::gsd, "gsd"},
                                                 EnumName{Exported::vtp, "vtp"},
                                                 EnumName{Exported::xyz, "xyz"},
                                                 EnumName{Exported::contacts, "contacts"},
                                                 EnumName{Exported::replicates, "replicates"},
                                                 EnumName{Exported::states, "states"}};

struct ExportArguments {
  std::string directory;  ///< of results
  std::string replicate;  ///< its name, or "all"
  Exported what = Exported::gsd;
  /// File; of packings of "all" the directory, created if it is missing, that takes <name>.<format>; of tables, empty
  /// for stdout.
  std::string output;
  bool path = false;      ///< every state of the expansion instead of the one nearest jamming
  bool contacts = false;  ///< with packings, their networks of contacts

  bool all() const { return replicate == "all"; }
};

/// The names of the replicates that are asked for: only names of records that are there ever become part of a path.
std::vector<std::string> chosen_names(const ExportArguments& arguments);

/// A record of this manifest, if the directory has one. Throws as read_record does.
RecordedReplicate own_record(const ExportArguments& arguments, const std::optional<Manifest>& manifest,
                             const std::string& name);

/// Says that a replicate has no packing, if it failed: an error where it was asked for by its name, or else a warning.
bool has_packing(const ExportArguments& arguments, const RecordedReplicate& held, Console& console);

/// Writes and lists on stdout what other programs open.
ExitCode export_packings(const ExportArguments& arguments, Console& console);

/// Writes a table as CSV, or as JSON lines to a file that is called .jsonl.
ExitCode export_rows(const ExportArguments& arguments, Console& console);

}  // namespace isojam
