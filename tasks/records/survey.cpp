#include "tasks/records/survey.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <functional>
#include <utility>

#include "tasks/io/file.hpp"
#include "tasks/io/input_error.hpp"
#include "tasks/io/place.hpp"
#include "tasks/io/sealed.hpp"
#include "tasks/manifest/cost.hpp"
#include "tasks/measure/quantity.hpp"
#include "tasks/records/checkpoint.hpp"
#include "tasks/records/recorded.hpp"
#include "tasks/records/requests.hpp"
#include "tasks/records/texts.hpp"

namespace isojam {
namespace {
namespace fs = std::filesystem;

double seconds_since(const fs::path& path) {
  std::error_code error;
  const auto written = fs::last_write_time(path, error);
  if (error) return 0;
  return std::max(0.0, std::chrono::duration<double>(fs::file_time_type::clock::now() - written).count());
}

UnderWay under_way(const fs::path& path) {
  const auto document = read_sealed(path.string());
  const JsonPlace root(document, path.string());
  UnderWay replicate;
  replicate.name = path.stem().string();
  replicate.steps = static_cast<int>(root.at("path").expect_list(list_of_steps));
  replicate.stage = root.at("stage").text();
  replicate.density = root.at("packing").at("density").number({0, 1e9});
  replicate.cpu_seconds = root.at("timing").at("cpu_seconds").number({0, 1e12});
  replicate.seconds_since_step = seconds_since(path);
  replicate.working = is_alive(read_writer(root));
  return replicate;
}

/// CPU times of records, and their estimates.
struct CpuTimes {
  double measured = 0, estimated = 0;
  std::optional<double> of_one;  ///< estimate for one replicate

  double ratio(double otherwise) const { return measured > 0 && estimated > 0 ? measured / estimated : otherwise; }
};
using TimesOfPoints = std::vector<CpuTimes>;

/// The place of a record in a plan that requests its name.
struct Asked {
  const Plan* plan;
  Plan::Place place;
  Standing standing;
};

/// Counts a record that has a place in the plan of a survey.
void count(const RecordedReplicate& held, const Asked& asked, Survey& survey, TimesOfPoints& times_of_points) {
  const auto& summary = held.summary;
  const auto& place = asked.place;
  auto& point = survey.points[place.point];
  if (asked.standing == Standing::foreign) ++point.taken, point.goal_values[place.replicate] = std::nullopt;
  if (asked.standing != Standing::requested) return;
  survey.lacking += !lacks(held, asked.plan->manifest().measures).empty();
  ++point.recorded;
  if (const auto& goal = asked.plan->manifest().replicates.goal) {
    point.goal_values[place.replicate] =
        has_any(summary, asked.plan->exclude()) ? std::nullopt : summary.values[*quantity_index(goal->quantity)];
  }
  point.failed += summary.failed;
  point.flagged += summary.flagged;
  for (const auto flag : summary.flags) ++survey.flags[flag];
  if (summary.failed) return;
  auto& times = times_of_points[place.point];
  if (!times.of_one) times.of_one = estimated_cost(asked.plan->at(place.point, 0), false).cpu_seconds;
  times.measured += summary.cpu_seconds;
  times.estimated += *times.of_one;
  ++survey.calibration_records;
}

void survey_records(const fs::path& directory, const std::vector<Plan>& plans, Surveys& surveys,
                    std::vector<TimesOfPoints>& times) {
  const bool with_paths = !plans.empty() && plans.front().manifest().keep_path;
  const bool has_goal = std::any_of(plans.begin(), plans.end(),
                                    [](const Plan& plan) { return plan.manifest().replicates.goal.has_value(); });
  const Abridgement kept{States::nearest, has_goal ? Keys::quantities : Keys::none};
  read_in_order(names_in(directory / "records"), [&](const std::string& name) -> std::function<void()> {
    try {
      auto held = read_record(directory, name, kept);
      check_companions(directory, held, with_paths);
      std::vector<std::optional<Asked>> asked(plans.size());
      for (std::size_t k = 0; k < plans.size(); ++k) {
        const auto place = plans[k].place_of(name);
        if (place && plans[k].requests(*place))
          asked[k] = {&plans[k], *place, standing_of(held, plans[k].digest(*place))};
      }
      return [&, name, held = std::move(held), asked = std::move(asked)] {
        bool is_requested = false;
        for (std::size_t k = 0; k < asked.size(); ++k) {
          if (!asked[k]) continue;
          is_requested = is_requested || asked[k]->standing == Standing::requested;
          count(held, *asked[k], surveys.of_plans[k], times[k]);
        }
        if (!is_requested) surveys.unasked.push_back(name);
      };
    } catch (const InputError& damage) {
      return [&, text = std::string(damage.what())] { surveys.damaged.push_back(text); };
    }
  });
}

void calibrate(const TimesOfPoints& times, Survey& survey) {
  CpuTimes all;
  for (const auto& point : times) {
    all.measured += point.measured;
    all.estimated += point.estimated;
  }
  for (std::size_t point = 0; point < times.size(); ++point)
    survey.points[point].calibration = times[point].ratio(all.ratio(1));
}

void survey_checkpoints(const fs::path& directory, const std::vector<Plan>& plans, Surveys& surveys) {
  const auto recorded = names_in(directory / "records");
  for (const auto& name : names_in(directory / "checkpoints")) {
    if (std::binary_search(recorded.begin(), recorded.end(), name)) continue;
    try {
      std::optional<UnderWay> replicate;
      for (std::size_t k = 0; k < plans.size(); ++k) {
        const auto place = plans[k].place_of(name);
        if (!place || !plans[k].requests(*place)) continue;
        if (!replicate) replicate = under_way(directory / "checkpoints" / (name + ".json"));
        surveys.of_plans[k].under_way.push_back(*replicate);
        ++surveys.of_plans[k].points[place->point].under_way;
      }
    } catch (const InputError& damage) {
      surveys.damaged.push_back(
          fmt::format("{}; the next run starts this replicate from the beginning", problem_line(damage.details())));
    } catch (const FileError& error) {
      // The checkpoint was removed after the folder was listed, because its replicate now has a record.
      if (error.reason() != FileError::Reason::missing) throw;
    }
  }
}

}  // namespace

Surveys surveys_of(const fs::path& directory, const std::vector<Plan>& plans) {
  Surveys surveys;
  std::vector<TimesOfPoints> times;
  for (const auto& plan : plans) {
    surveys.of_plans.emplace_back().points.resize(plan.points());
    times.emplace_back(plan.points());
  }
  survey_records(directory, plans, surveys, times);
  for (std::size_t k = 0; k < plans.size(); ++k) calibrate(times[k], surveys.of_plans[k]);
  survey_checkpoints(directory, plans, surveys);
  return surveys;
}

}  // namespace isojam
