#pragma once

#include <string>

#include "tasks/commands/run.hpp"
#include "tasks/io/exit_codes.hpp"
#include "tasks/manifest/plan.hpp"

namespace isojam {

/// Prints a line for every sweep point: the number of replicates, how many of them are recorded, and the estimated CPU
/// time of each. Then prints the estimated time, disk space and memory that the remaining replicates need. If there are
/// records, the estimate is scaled to their times. It writes no file.
ExitCode dry_run(const Manifest& manifest, const Plan& plan, const std::string& directory,
                 const RunArguments& arguments);

}  // namespace isojam
