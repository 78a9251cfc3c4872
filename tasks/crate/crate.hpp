#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "tasks/json/json.hpp"
#include "tasks/store/store.hpp"

namespace isojam {

/// Under this name a directory is known as a crate.
inline constexpr auto crate_name = "ro-crate-metadata.json";

/// What a results directory does not know of itself.
struct CrateOptions {
  std::string date;                    ///< on which it is published, "2026-01-31"
  std::optional<std::string> license;  ///< of the data: an address
  std::optional<std::string> agent;    ///< who ran it: a name
  std::optional<std::string> agent_address;
};

/// Description of a results directory as a Process Run Crate 0.5, an RO-Crate 1.1: its manifest, records, packings,
/// paths, table and report with SHA-256 and size, and for every build of isojam that made records the run that made
/// them. A function of these files and of the options; checkpoints, temporaries and files of others are not in it.
/// Throws FileError if the directory holds no records, has no manifest, or lacks a packing or path; InputError for any
/// file that is damaged or belongs to another record. Records of another manifest are warned of and left out.
Json crate_metadata(const std::filesystem::path& directory, const CrateOptions& options, const Warn& warn);

}  // namespace isojam
