#pragma once

#include <string>
#include <vector>

#include "tasks/console.hpp"
#include "tasks/exit_codes.hpp"
#include "tasks/shard.hpp"

namespace isojam {

struct RunCommand {
  std::string manifest;
  std::string directory;  ///< empty: results/<name of the manifest>
  int threads = 0;        ///< 0: as many as the machine gives this process
  double memory_gib = 0;  ///< for replicates in flight; 0: what is available
  Shard shard;
  bool dry_run = false;
};

/// Validates, plans, runs what the directory does not hold yet, aggregates. The table goes to stdout; a shard leaves
/// it to whoever runs when all are finished. A dry run prints the plan and what it will cost, and writes nothing.
ExitCode run(const RunCommand& command, Console& console);

struct ValidateCommand {
  std::string manifest;
};

ExitCode validate(const ValidateCommand& command);

enum class TableFormat { text, json, csv, latex };

struct AggregateCommand {
  std::vector<std::string> directories;
  std::string output;  ///< tables.json to write; empty: none
  TableFormat format = TableFormat::text;
  bool series = false;  ///< quantities against Δφ instead of those nearest jamming; JSON has both
};

/// Reads only, but for the output asked for. The table goes to stdout in the format asked for.
ExitCode aggregate_directories(const AggregateCommand& command);

struct StatusCommand {
  std::string directory;
};

/// What a results directory holds and what is under way in it, whoever works on it. Reads only.
ExitCode status(const StatusCommand& command);

struct RerunCommand {
  std::string directory;
  std::string replicate;  ///< name, as its files are called
  int threads = 0;
};

/// Redoes a replicate of a results directory from the start, with a line for every strain step, replaces what was
/// recorded and says whether the bits are the same. The record goes to stdout.
ExitCode rerun(const RerunCommand& command, Console& console);

}  // namespace isojam
