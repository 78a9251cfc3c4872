#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tasks/extras/export/formats.hpp"
#include "tasks/io/console.hpp"
#include "tasks/io/exit_codes.hpp"
#include "tasks/io/place.hpp"
#include "tasks/records/requests.hpp"

namespace isojam {

struct ExportArguments {
  std::string directory;  ///< results directory
  std::string replicate;  ///< name of a replicate; "all" for every recorded replicate
  Exported what = Exported::gsd;
  /// Output path.
  /// - Packing of one replicate: the file. The path must not be empty. Some formats write more files beside it, see
  ///   exported_files().
  /// - Packings of all replicates: the directory for the files <name>.<extension>, which is created if it is missing.
  ///   The path must not be empty.
  /// - Table: the file; empty for standard output.
  std::string output;
  bool path = false;      ///< export all states of the decompression; otherwise only the nearest state
  bool contacts = false;  ///< also export the contact networks of the packings

  bool all() const { return replicate == "all"; }
};

/// Names of the replicates to export. If the user gave a name, throws UsageError unless a record has this name. With
/// this check, text such as "../x" cannot become part of a path.
std::vector<std::string> chosen_names(const ExportArguments& arguments);

/// Reads a record, or a part of it. If there are requests and the record is foreign to them, throws InputError.
RecordedReplicate own_record(const ExportArguments& arguments, const Requests& requests, const std::string& name,
                             const std::optional<Abridgement>& kept = std::nullopt);

/// True if the replicate did not fail. For a failed replicate, prints a warning and returns false if all replicates are
/// exported. If the user gave the name of a failed replicate, throws UsageError.
bool has_packing(const ExportArguments& arguments, const RecordedReplicate& held, Console& console);

/// Writes files with packings for other programs, and prints the paths of these files to standard output.
ExitCode export_packings(const ExportArguments& arguments, Console& console);

/// Writes a table as CSV, or as JSON lines if the output path ends in .jsonl; or the solids as JSON.
ExitCode export_rows(const ExportArguments& arguments, Console& console);

}  // namespace isojam
