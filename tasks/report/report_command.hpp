#pragma once

#include <string>

#include "tasks/exit_codes.hpp"

namespace isojam {

struct ReportCommand {
  std::string directory;
  std::string output;  ///< empty: report.html in the directory
};

/// Writes a results directory as one interactive HTML file; its path goes to stdout. Throws FileError if the directory
/// holds no records or the file cannot be written, InputError for a damaged record or packing.
ExitCode report(const ReportCommand& command);

}  // namespace isojam
