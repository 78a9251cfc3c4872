#include <fmt/format.h>

#include <algorithm>
#include <cstddef>

#include "tasks/commands/command.hpp"
#include "tasks/commands/shared.hpp"
#include "tasks/io/standard_streams.hpp"
#include "tasks/manifest/cost.hpp"
#include "tasks/records/recorded.hpp"
#include "tasks/records/survey.hpp"

namespace isojam {
namespace {

/// A step can take minutes. For a replicate on another machine, only the time of the last step is known. After this
/// time without a step, it counts as interrupted.
constexpr double patience_seconds = 600;

struct StatusArguments {
  std::string directory;
};

struct Totals {
  int recorded = 0, failed = 0, flagged = 0;
  double cpu_left = 0;
};

bool is_moving(const UnderWay& replicate) {
  return replicate.working.value_or(replicate.seconds_since_step < patience_seconds);
}

Totals totals_of(const Survey& survey, const Plan& plan) {
  Totals totals;
  for (std::size_t point = 0; point < plan.points(); ++point) {
    const auto& held = survey.points[point];
    totals.recorded += held.recorded;
    totals.failed += held.failed;
    totals.flagged += held.flagged;
    totals.cpu_left += std::max(0, plan.replicates() - held.recorded) *
                       estimated_cost(plan.at(point, 0), false).cpu_seconds * survey.calibration;
  }
  for (const auto& replicate : survey.under_way) totals.cpu_left -= replicate.cpu_seconds;
  totals.cpu_left = std::max(0.0, totals.cpu_left);
  return totals;
}

std::string time_left(const Survey& survey, const Totals& totals, bool has_goal) {
  const auto moving = std::count_if(survey.under_way.begin(), survey.under_way.end(), is_moving);
  const auto* at_most = has_goal ? "at most " : "";
  if (totals.cpu_left == 0) return "";
  if (moving == 0)
    return fmt::format("no process is working on it; {}{} of CPU time left\n", at_most, about_text(totals.cpu_left));
  return fmt::format("{}{} left with {} at a time\n", at_most,
                     about_text(totals.cpu_left / static_cast<double>(moving)),
                     counted(static_cast<std::size_t>(moving), "replicate"));
}

/// Lists the contents of a results directory, and the replicates on which any process works. Writes no file.
ExitCode status(const StatusArguments& arguments, Console&) {
  const auto manifest = own_manifest(arguments.directory);
  const Plan plan(manifest);
  const auto survey = survey_of(arguments.directory, plan, manifest.keep_path);
  const auto totals = totals_of(survey, plan);
  const auto moving = std::count_if(survey.under_way.begin(), survey.under_way.end(), is_moving);
  const auto stopped = static_cast<std::ptrdiff_t>(survey.under_way.size()) - moving;
  auto text =
      fmt::format("{}: {} of {}{} recorded, {} failed, {} flagged, {} running{}\n", manifest.name, totals.recorded,
                  manifest.replicates.goal ? "up to " : "", counted(plan.size(), "replicate"), totals.failed,
                  totals.flagged, moving, stopped > 0 ? fmt::format(", {} interrupted", stopped) : "");
  if (survey.unplanned > 0)
    text += fmt::format("  {} not planned by the manifest\n",
                        counted(static_cast<std::size_t>(survey.unplanned), "record"));
  if (survey.lacking > 0)
    text += fmt::format("  {} without measures added later; run \"isojam measure {}\" to add them\n",
                        counted(static_cast<std::size_t>(survey.lacking), "record"), arguments.directory);
  for (const auto& [flag, count] : survey.flags) text += fmt::format("  flagged {}: {}\n", to_string(flag), count);
  for (const auto& replicate : survey.under_way) {
    text +=
        fmt::format("  {}: {}{}, density {:.4f}, {} steps, {} of CPU, last step {} ago\n", replicate.name,
                    is_moving(replicate) ? "" : "interrupted in ", replicate.stage, replicate.density, replicate.steps,
                    duration_text(replicate.cpu_seconds), duration_text(replicate.seconds_since_step));
  }
  for (const auto& line : survey.damaged) text += fmt::format("  damaged: {}\n", line);
  print(text + time_left(survey, totals, manifest.replicates.goal.has_value()));
  return ExitCode::done;
}

}  // namespace

void add_status(CLI::App& app, Session& session) {
  StatusArguments* arguments = nullptr;
  auto options = add_command(app, session, "status", "Show the progress and the contents of a results directory",
                             status, arguments);
  options.results_directory(arguments->directory);
}

}  // namespace isojam
