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
  const auto per_point = manifest.replicates.goal
                             ? fmt::format("{} to {} replicates", manifest.replicates.min, manifest.replicates.max)
                             : counted(static_cast<std::size_t>(manifest.replicates.max), "replicate");
  print(fmt::format("OK: {}: {}{} ({} with {} each)\n", manifest.name, manifest.replicates.goal ? "up to " : "",
                    counted(plan.size(), "replicate"), counted(plan.points(), "sweep point"), per_point) +
        definitions_text(manifest));
  return ExitCode::done;
}

}  // namespace

void add_validate(CLI::App& app, Session& session) {
  ValidateArguments* arguments = nullptr;
  auto options = add_command(app, session, "validate",
                             "Check a manifest; print its number of replicates, and a line for each user-defined solid",
                             validate, arguments);
  options.text("manifest", arguments->manifest, "Manifest of the study (-: standard input)", "MANIFEST",
               Options::Need::required);
}

}  // namespace isojam
