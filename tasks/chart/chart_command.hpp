#pragma once

#include <string>

#include "tasks/console.hpp"
#include "tasks/exit_codes.hpp"

namespace isojam {

struct ChartCommand {
  std::string config;  ///< empty: the built-in one
  bool full = false;   ///< the built-in one for an hour
  std::string directory;
};

/// Compares methods on this machine and writes data.json, table.txt and chart.html to the directory, which is made if
/// need be. The table goes to stdout, its last three lines the conclusion. After a signal what was measured is written.
/// Throws InputError for a bad configuration, FileError for files that cannot be read or written.
ExitCode chart(const ChartCommand& command, Console& console);

}  // namespace isojam
