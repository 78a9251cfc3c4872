#pragma once

#include <string>

#include "tasks/commands/run.hpp"
#include "tasks/io/exit_codes.hpp"
#include "tasks/manifest/plan.hpp"

namespace isojam {

/// Prints a line for every sweep point: the number of replicates, the number of recorded replicates, and an estimate of
/// the CPU time, disk space and memory of the other replicates. If there are records, their times are used to scale the
/// estimate. The function writes no file.
ExitCode dry_run(const Manifest& manifest, const Plan& plan, const std::string& directory,
                 const RunArguments& arguments);

}  // namespace isojam
