#pragma once

#include <string>

#include "tasks/commands/run.hpp"
#include "tasks/manifest/plan.hpp"
#include "tasks/system/exit_codes.hpp"

namespace isojam {

/// Prints every sweep point with its replicates, those recorded already, and what is left to do in CPU time, disk and
/// memory; the times are scaled by those of the records that are there. Writes nothing.
ExitCode dry_run(const Manifest& manifest, const Plan& plan, const std::string& directory,
                 const RunArguments& arguments);

}  // namespace isojam
