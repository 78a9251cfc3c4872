#pragma once

#include <string>
#include <vector>

#include "tasks/console.hpp"
#include "tasks/exit_codes.hpp"

namespace isojam {

struct RunCommand {
  std::string manifest;
  std::string directory;  ///< empty: results/<name of the manifest>
  int threads = 0;        ///< 0: as many as the machine gives this process
};

/// Validates, plans, runs what the directory does not hold yet, aggregates. The table goes to stdout.
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

}  // namespace isojam
