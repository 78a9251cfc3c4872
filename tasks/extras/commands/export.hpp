#pragma once

#include <array>
#include <string>
#include <vector>

#include "engine/names/enum_names.hpp"
#include "tasks/io/console.hpp"
#include "tasks/io/exit_codes.hpp"
#include "tasks/io/place.hpp"
#include "tasks/records/recorded.hpp"

namespace isojam {

/// Formats of an export: packings for other programs, or tables of contacts, replicates or states.
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
  /// Output path. For packings of all replicates, it is the directory for the files <name>.<format>, which is created
  /// if it is missing. For tables, it is a file; empty means standard output.
  std::string output;
  bool path = false;      ///< export all states of the decompression instead of only the state nearest jamming
  bool contacts = false;  ///< also export the contact networks of packings

  bool all() const { return replicate == "all"; }
};

/// Names of the requested replicates. They are names of existing records, so no other text becomes a part of a path.
std::vector<std::string> chosen_names(const ExportArguments& arguments);

/// Reads a record and checks that it belongs to this manifest, if there is one. Throws the same exceptions as
/// read_record().
RecordedReplicate own_record(const ExportArguments& arguments, const std::optional<Manifest>& manifest,
                             const std::string& name);

/// Returns false if the replicate failed and therefore has no packing. If the user requested this replicate by name,
/// throws an error; otherwise prints a warning.
bool has_packing(const ExportArguments& arguments, const RecordedReplicate& held, Console& console);

/// Writes packings in files for other programs, and prints the paths of the files to standard output.
ExitCode export_packings(const ExportArguments& arguments, Console& console);

/// Writes a table as CSV, or as JSON lines if the file name ends in .jsonl.
ExitCode export_rows(const ExportArguments& arguments, Console& console);

}  // namespace isojam
