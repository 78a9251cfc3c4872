#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "tasks/manifest/plan.hpp"
#include "tasks/measure/flag.hpp"

namespace isojam {

/// A replicate that has a checkpoint but no record.
struct UnderWay {
  std::string name;
  std::string stage;
  double density = 0;
  int steps = 0;
  double cpu_seconds = 0;  ///< CPU time that the replicate has taken so far
  double seconds_since_step = 0;
  /// whether the process that wrote the checkpoint still runs; nullopt if it ran on another machine
  std::optional<bool> working;
};

/// Numbers of files in a results directory, for each sweep point.
struct Survey {
  struct Point {
    int recorded = 0, failed = 0, flagged = 0, under_way = 0;
  };
  std::vector<Point> points;        ///< sweep points of the plan
  std::map<Flag, int> flags;        ///< number of replicates of the plan that have this flag
  std::vector<std::string> others;  ///< names of the records that belong to another manifest
  int lacking = 0;                  ///< number of records that lack measures which were later added to the manifest
  int unplanned = 0;                ///< number of records that are not in the plan
  std::vector<UnderWay> under_way;
  std::vector<std::string> damaged;  ///< one line for each damaged file
  /// Measured CPU time divided by the estimated CPU time, over all records; 1 if there are no records.
  double calibration = 1;
  int calibration_records = 0;
};

/// Makes a survey of a directory. It only reads files. If the directory does not exist, the survey is empty. A record
/// counts as damaged if `isojam run` would recompute it. This includes a record whose packing is missing or belongs to
/// another record, and, if `with_paths` is true, a record whose path is. Throws FileError if a file cannot be read at
/// the moment.
Survey survey_of(const std::filesystem::path& directory, const Plan& plan, bool with_paths);

}  // namespace isojam
