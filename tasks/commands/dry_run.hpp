#pragma once

#include <string>

#include "tasks/commands/run.hpp"
#include "tasks/io/exit_codes.hpp"
#include "tasks/manifest/plan.hpp"

namespace isojam {

/// Prints a line for every sweep point: the number of replicates, how many of them are recorded, and the estimated CPU
/// time of a replicate. Then prints estimates for the remaining replicates: their time and disk space, and the memory
/// of the replicate that needs the most memory. If there are records, the estimated times are scaled to the times in
/// these records. The function writes no file.
/// Throws InputError if the directory has records of another manifest.
ExitCode dry_run(const Manifest& manifest, const Plan& plan, const std::string& directory,
                 const RunArguments& arguments);

}  // namespace isojam
