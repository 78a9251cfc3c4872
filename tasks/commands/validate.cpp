#include <fmt/format.h>

#include "tasks/commands/command.hpp"
#include "tasks/commands/shared.hpp"
#include "tasks/io/standard_streams.hpp"
#include "tasks/manifest/plan.hpp"

namespace isojam {
namespace {

struct ValidateArguments {
  std::string manifest;
};

ExitCode validate(const ValidateArguments& arguments, Console& console) {
  const auto manifest = read_manifest(arguments.manifest);
  warn_about(manifest, arguments.manifest, console);
  const Plan plan(manifest);
  const auto each = manifest.replicates.goal ? fmt::format("{} to {}", manifest.replicates.min, manifest.replicates.max)
                                             : std::to_string(manifest.replicates.max);
  print(fmt::format("OK: {}: {}{} ({} × {})\n", manifest.name, manifest.replicates.goal ? "up to " : "",
                    counted(plan.size(), "replicate"), counted(plan.points(), "sweep point"), each) +
        definitions_text(manifest));
  return ExitCode::done;
}

}  // namespace

void add_validate(CLI::App& app, Session& session) {
  ValidateArguments* arguments = nullptr;
  auto options =
      add_command(app, session, "validate", "Check a manifest, and print its solids and its number of replicates",
                  validate, arguments);
  options.text("manifest", arguments->manifest, "Manifest of the sweep (-: standard input)", "MANIFEST",
               Options::Need::required);
}

}  // namespace isojam
