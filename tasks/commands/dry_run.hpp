#pragma once

#include <string>

#include "tasks/commands/run.hpp"
#include "tasks/manifest/plan.hpp"
#include "tasks/system/exit_codes.hpp"

namespace isojam {

/// Prints every sweep point with its replicates, the number already recorded, and the CPU time, disk space and memory
/// that the rest will need. Times are scaled by those of existing records. Writes nothing.
ExitCode dry_run(const Manifest& manifest, const Plan& plan, const std::string& directory,
                 const RunArguments& arguments);

}  // namespace isojam
