#pragma once

#include <string>

#include "tasks/system/console.hpp"
#include "tasks/system/exit_codes.hpp"

// The commands that write pages need Vega and three.js. Without them (ISOJAM_PAGES=OFF) report.cpp and chart.cpp are
// not compiled, and pages.cpp names the packages instead.

namespace isojam {

struct ReportArguments {
  std::string directory;
  std::string output;  ///< empty: report.html in the directory
};

/// Writes a results directory as one interactive HTML file; its path goes to stdout.
ExitCode report(const ReportArguments& arguments, Console& console);

struct ChartArguments {
  std::string config;  ///< empty: the built-in one
  bool full = false;   ///< the built-in one for an hour
  std::string directory;
};

/// Compares methods on this machine and writes data.json, table.txt and chart.html to the directory, which is created
/// if it is missing. The table goes to stdout; its last three lines are the conclusion. After a signal the measurements
/// made so far are written.
ExitCode chart(const ChartArguments& arguments, Console& console);

}  // namespace isojam
