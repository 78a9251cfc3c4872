#include <fmt/format.h>

#include "tasks/commands.hpp"
#include "tasks/commands/shared.hpp"
#include "tasks/plan.hpp"

namespace isojam {

ExitCode validate(const ValidateCommand& command) {
  const auto manifest = read_manifest(command.manifest);
  const Plan plan(manifest);
  const auto each = manifest.replicates.goal ? fmt::format("{} to {}", manifest.replicates.min, manifest.replicates.max)
                                             : std::to_string(manifest.replicates.max);
  print(fmt::format("OK: {}: {}{} replicates ({} sweep points × {})\n", manifest.name,
                    manifest.replicates.goal ? "up to " : "", plan.size(), plan.points(), each));
  return ExitCode::done;
}

}  // namespace isojam
