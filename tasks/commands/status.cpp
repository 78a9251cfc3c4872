#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "tasks/commands/command.hpp"
#include "tasks/commands/shared.hpp"
#include "tasks/io/standard_streams.hpp"
#include "tasks/manifest/cost.hpp"
#include "tasks/records/recorded.hpp"
#include "tasks/records/replicate.hpp"
#include "tasks/records/requests.hpp"
#include "tasks/records/survey.hpp"
#include "tasks/tables/stopping.hpp"

namespace isojam {
namespace {

/// A replicate on another machine counts as interrupted if it has made no step for this time. Steps can take minutes.
constexpr double running_limit_seconds = 600;

struct StatusArguments {
  std::string directory;
};

struct Totals {
  int recorded = 0, failed = 0, flagged = 0, taken = 0;
  double cpu_left = 0;
};

bool is_running(const UnderWay& replicate) {
  return replicate.working.value_or(replicate.seconds_since_step < running_limit_seconds);
}

/// Values for the stopping rule, up to the first replicate that is not recorded.
std::vector<std::optional<double>> values_of(const Survey::Point& point) {
  std::vector<std::optional<double>> values;
  for (const auto& [replicate, value] : point.goal_values) {
    if (replicate != static_cast<int>(values.size())) break;
    values.push_back(value);
  }
  return values;
}

/// Largest number of replicates of a sweep point that the next run can start.
int replicates_left(const Survey::Point& point, const Manifest& manifest) {
  const auto& rule = manifest.replicates;
  if (rule.goal && advance_of(rule, values_of(point)).finished) return 0;
  return std::max(0, rule.max - point.recorded - point.taken);
}

Totals totals_of(const Survey& survey, const Plan& plan) {
  Totals totals;
  for (std::size_t point = 0; point < plan.points(); ++point) {
    const auto& counts = survey.points[point];
    totals.recorded += counts.recorded;
    totals.failed += counts.failed;
    totals.flagged += counts.flagged;
    totals.taken += counts.taken;
    totals.cpu_left += replicates_left(counts, plan.manifest()) * estimated_cost(plan.at(point, 0), false).cpu_seconds *
                       counts.calibration;
  }
  for (const auto& replicate : survey.under_way) totals.cpu_left -= replicate.cpu_seconds;
  totals.cpu_left = std::max(0.0, totals.cpu_left);
  return totals;
}

std::string time_left(const Totals& totals, std::size_t running, bool has_goal) {
  const auto* at_most = has_goal ? "at most " : "";
  if (totals.cpu_left == 0) return "";
  if (running == 0)
    return fmt::format("no process works in this directory; the missing replicates need {}{} of CPU time\n", at_most,
                       about_text(totals.cpu_left));
  return fmt::format("{}{} left if {} run{} at the same time\n", at_most,
                     about_text(totals.cpu_left / static_cast<double>(running)), counted(running, "replicate"),
                     running == 1 ? "s" : "");
}

/// Names of the flags, with the numbers of replicates that have them: " (crystalline 2, not_balanced 1)".
std::string flags_text(const Survey& survey) {
  std::vector<std::string> counts;
  for (const auto& [flag, count] : survey.flags) counts.push_back(fmt::format("{} {}", to_string(flag), count));
  return counts.empty() ? "" : fmt::format(" ({})", fmt::join(counts, ", "));
}

/// The line of a manifest, and the time left for it.
std::string text_of(const Survey& survey, const Plan& plan) {
  const auto totals = totals_of(survey, plan);
  const auto running =
      static_cast<std::size_t>(std::count_if(survey.under_way.begin(), survey.under_way.end(), is_running));
  const auto interrupted = survey.under_way.size() - running;
  const bool has_goal = plan.manifest().replicates.goal.has_value();
  return fmt::format("{}: {} of {}{} recorded, {} failed, {} flagged{}, {} running{}{}\n", plan.manifest().name,
                     totals.recorded, has_goal ? "up to " : "", counted(plan.size(), "replicate"), totals.failed,
                     totals.flagged, flags_text(survey), running,
                     interrupted > 0 ? fmt::format(", {} interrupted", interrupted) : "",
                     totals.taken > 0 ? fmt::format(", {} taken by other settings", totals.taken) : "") +
         time_left(totals, running, has_goal);
}

/// True if a replicate of the plan is missing.
bool is_incomplete(const Survey& survey, const Plan& plan) {
  return std::any_of(survey.points.begin(), survey.points.end(),
                     [&](const Survey::Point& point) { return replicates_left(point, plan.manifest()) > 0; });
}

/// Prints the progress of a results directory: recorded, running and interrupted replicates of the last manifest and of
/// earlier manifests that are not complete, flags, and problems. Writes no file.
ExitCode status(const StatusArguments& arguments, Console& console) {
  own_manifest(arguments.directory);
  const auto plans = requests_in(arguments.directory, [&](const std::string& message) { console.warn(message); });
  const auto surveys = surveys_of(arguments.directory, plans);
  const auto& last = surveys.of_plans.front();
  auto text = text_of(last, plans.front());
  for (std::size_t k = 1; k < plans.size(); ++k) {
    if (is_incomplete(surveys.of_plans[k], plans[k])) text += "before, " + text_of(surveys.of_plans[k], plans[k]);
  }
  if (const auto unasked = surveys.unasked.size(); unasked > 0)
    text += fmt::format("  {} {} requested by no manifest, for example {}\n", counted(unasked, "record"),
                        unasked == 1 ? "is" : "are", surveys.unasked.front());
  if (last.lacking > 0)
    text += fmt::format("  {} without measures of the manifest; add them with \"isojam measure {}\"\n",
                        counted(static_cast<std::size_t>(last.lacking), "record"), shell_argument(arguments.directory));
  for (const auto& replicate : last.under_way) {
    text +=
        fmt::format("  {}: {}{} at density {:.4f}, {} steps, {} of CPU time, last step {} ago\n", replicate.name,
                    is_running(replicate) ? "" : "interrupted in ", replicate.stage, replicate.density, replicate.steps,
                    duration_text(replicate.cpu_seconds), duration_text(replicate.seconds_since_step));
  }
  for (const auto& line : surveys.damaged) text += fmt::format("  problem: {}\n", line);
  print(text);
  return ExitCode::done;
}

}  // namespace

void add_status(CLI::App& app, Session& session) {
  StatusArguments* arguments = nullptr;
  auto options =
      add_command(app, session, "status", "Show the progress of a study, and problems of its files", status, arguments);
  options.results_directory(arguments->directory);
}

}  // namespace isojam
