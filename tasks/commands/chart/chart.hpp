#pragma once

#include <string>

#include "tasks/commands/command.hpp"

namespace isojam {

struct ChartArguments {
  std::string config;  ///< empty: the built-in one
  bool full = false;   ///< the built-in one for an hour
  std::string directory;
};

// The methods that are compared, their references in 50 digits and the atlas of failures are a program of their own,
// isojam-chart: who jams packings neither compiles nor carries them. It has every command; `isojam` hands it the words
// of this one, chart_beside.cpp, and it does the work, chart_here.cpp.

/// Compares methods on this machine and writes data.json, table.txt and chart.html to the directory, which is made if
/// need be. The table goes to stdout, its last three lines the conclusion. After a signal what was measured is written.
ExitCode chart(const ChartArguments& arguments, const Session& session, Console& console);

}  // namespace isojam
