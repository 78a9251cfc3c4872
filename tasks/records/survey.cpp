#include "tasks/records/survey.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>

#include "tasks/io/file.hpp"
#include "tasks/io/input_error.hpp"
#include "tasks/io/place.hpp"
#include "tasks/io/sealed.hpp"
#include "tasks/manifest/cost.hpp"
#include "tasks/measure/quantity.hpp"
#include "tasks/records/checkpoint.hpp"
#include "tasks/records/recorded.hpp"
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

  double ratio(double otherwise) const { return measured > 0 && estimated > 0 ? measured / estimated : otherwise; }
};

void survey_records(const fs::path& directory, const Plan& plan, bool with_paths, Survey& survey) {
  std::vector<CpuTimes> times(survey.points.size());
  for (const auto& name : names_in(directory / "records")) {
    try {
      const auto held = read_record_without_states(directory, name);
      const auto& summary = held.summary;
      const auto place = plan.place_of(name);
      if (!place) {
        ++survey.unplanned;
        continue;
      }
      check_companions(directory, held, with_paths);
      const auto spec = plan.at(place->point, place->replicate);
      if (is_superseded(held, plan)) continue;
      if (!is_of(held, plan)) {
        survey.others.push_back(name);
        survey.damaged.push_back(fmt::format("{}: {}", name, other_manifest));
        continue;
      }
      check_spec(held, spec);
      survey.lacking += !lacks(held, plan.manifest()).empty();
      auto& point = survey.points[place->point];
      ++point.recorded;
      if (const auto& goal = plan.manifest().replicates.goal) {
        point.goal_values[place->replicate] =
            has_any(summary, plan.exclude()) ? std::nullopt : summary.values[*quantity_index(goal->quantity)];
      }
      point.failed += summary.failed;
      point.flagged += summary.flagged;
      for (const auto flag : summary.flags) ++survey.flags[flag];
      if (summary.failed) continue;
      times[place->point].measured += summary.cpu_seconds;
      times[place->point].estimated += estimated_cost(spec, false).cpu_seconds;
      ++survey.calibration_records;
    } catch (const InputError& damage) {
      survey.damaged.emplace_back(damage.what());
    }
  }
  CpuTimes all;
  for (const auto& point : times) {
    all.measured += point.measured;
    all.estimated += point.estimated;
  }
  for (std::size_t point = 0; point < times.size(); ++point)
    survey.points[point].calibration = times[point].ratio(all.ratio(1));
}

void survey_checkpoints(const fs::path& directory, const Plan& plan, Survey& survey) {
  const auto recorded = names_in(directory / "records");
  for (const auto& name : names_in(directory / "checkpoints")) {
    const auto place = plan.place_of(name);
    if (!place || std::binary_search(recorded.begin(), recorded.end(), name)) continue;
    try {
      survey.under_way.push_back(under_way(directory / "checkpoints" / (name + ".json")));
      ++survey.points[place->point].under_way;
    } catch (const InputError& damage) {
      survey.damaged.push_back(
          fmt::format("{}; the next run starts this replicate from the beginning", problem_line(damage.details())));
    } catch (const FileError& error) {
      // The checkpoint was removed after the folder was listed, because its replicate now has a record.
      if (error.reason() != FileError::Reason::missing) throw;
    }
  }
}

}  // namespace

Survey survey_of(const fs::path& directory, const Plan& plan, bool with_paths) {
  Survey survey;
  survey.points.resize(plan.points());
  survey_records(directory, plan, with_paths, survey);
  survey_checkpoints(directory, plan, survey);
  return survey;
}

}  // namespace isojam
