#include <fmt/format.h>

#include "tasks/commands/command.hpp"
#include "tasks/commands/shared.hpp"
#include "tasks/manifest/plan.hpp"
#include "tasks/system/standard_streams.hpp"

namespace isojam {
namespace {

struct Arguments {
  std::string manifest;
};

ExitCode validate(const Arguments& arguments, Console& console) {
  const auto manifest = read_manifest(arguments.manifest);
  warn_about(manifest, arguments.manifest, console);
  const Plan plan(manifest);
  const auto each = manifest.replicates.goal ? fmt::format("{} to {}", manifest.replicates.min, manifest.replicates.max)
                                             : std::to_string(manifest.replicates.max);
  print(fmt::format("OK: {}: {}{} ({} × {})\n", manifest.name, manifest.replicates.goal ? "up to " : "",
                    counted(plan.size(), "replicate"), counted(plan.points(), "sweep point"), each));
  return ExitCode::done;
}

}  // namespace

void add_validate(CLI::App& app, Session& session) {
  Arguments* arguments = nullptr;
  auto options = add_command(app, session, "validate", "Check a manifest and say how many replicates it plans",
                             validate, arguments);
  options.text("manifest", arguments->manifest, "Manifest of the sweep; - is standard input", "MANIFEST",
               Options::Need::required);
}

}  // namespace isojam
