#pragma once

#include <string>

#include "tasks/io/console.hpp"
#include "tasks/io/exit_codes.hpp"

// The commands that write pages need Vega and three.js. Without them (ISOJAM_PAGES=OFF) report.cpp and chart.cpp are
// not compiled, and pages.cpp names the packages instead.

namespace isojam {

struct ReportArguments {
  std::string directory;
  std::string output;  ///< output path; empty: report.html in the results directory
};

/// Writes the report of a results directory as one interactive HTML file, and prints the path of the file to standard
/// output.
ExitCode report(const ReportArguments& arguments, Console& console);

struct ChartArguments {
  std::string config;  ///< path of a configuration; empty: the default configuration
  bool full = false;   ///< use the built-in configuration that takes an hour
  std::string directory;
};

/// Compares methods on this machine, and writes data.json, table.txt and chart.html to the directory. The directory is
/// created if it is missing. The table is also printed to standard output; its last three lines are the conclusion.
/// After a signal, the results that were measured so far are written.
ExitCode chart(const ChartArguments& arguments, Console& console);

}  // namespace isojam
