#pragma once

#include <string>
#include <vector>

#include "tasks/io/console.hpp"
#include "tasks/io/exit_codes.hpp"

// The commands that write HTML pages need Vega and three.js. Without these (ISOJAM_PAGES=OFF), report.cpp and chart.cpp
// are not compiled. The commands then only print an error that names the missing packages.

namespace isojam {

struct ReportArguments {
  std::vector<std::string> directories;
  std::string output;  ///< output path; empty means report.html in the only results directory
};

/// Writes the report of results directories as one interactive HTML file, and prints its path to standard output.
ExitCode report(const ReportArguments& arguments, Console& console);

struct ChartArguments {
  std::string config;  ///< path of a configuration; empty means a built-in configuration
  bool full = false;   ///< use the built-in configuration that takes an hour instead of the one that takes five minutes
  /// output directory
  std::string directory;
};

/// Compares methods on this machine, and writes data.json, table.txt and chart.html to the directory, which is created
/// if it is missing. Prints the table to standard output. After a signal, writes the
/// results that have been measured so far.
ExitCode chart(const ChartArguments& arguments, Console& console);

}  // namespace isojam
