#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "tasks/manifest/plan.hpp"
#include "tasks/measure/flag.hpp"

namespace isojam {

/// A replicate that has a checkpoint and no record.
struct UnderWay {
  std::string name;
  std::string stage;
  double density = 0;
  int steps = 0;
  double cpu_seconds = 0;  ///< spent on it so far
  double seconds_since_step = 0;
  std::optional<bool> working;  ///< whether the process that wrote it still runs; nullopt on another machine
};

/// Counts of a results directory, by sweep point.
struct Survey {
  struct Point {
    int recorded = 0, failed = 0, flagged = 0, under_way = 0;
  };
  std::vector<Point> points;        ///< of the plan
  std::map<Flag, int> flags;        ///< replicates of the plan that have it
  std::vector<std::string> others;  ///< records that belong to another manifest
  int lacking = 0;                  ///< records without measures that were added to the manifest since
  int unplanned = 0;                ///< records that the plan does not know
  std::vector<UnderWay> under_way;
  std::vector<std::string> damaged;  ///< one line for each file
  /// Measured CPU time over the estimated, of all records; 1 without any.
  double calibration = 1;
  int calibration_records = 0;
};

/// Surveys a directory, reading only; an empty survey if there is no such directory. A record counts as damaged if
/// `run` would redo it. This includes a record whose packing, or `with_paths` whose path, is missing or belongs to
/// another record. Throws FileError for files that cannot be read now.
Survey survey_of(const std::filesystem::path& directory, const Plan& plan, bool with_paths);

}  // namespace isojam
