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
  /// time since the last strain step
  double seconds_since_step = 0;
  /// true if the process that wrote the checkpoint still runs; nullopt if it ran on another machine
  std::optional<bool> working;
};

/// Numbers of replicates of a plan in a results directory.
struct Survey {
  struct Point {
    int recorded = 0, failed = 0, flagged = 0, under_way = 0;
    int taken = 0;  ///< replicates whose name a record with another specification has, which did not fail
    /// Only with a stopping rule: its quantity for each recorded replicate, by number of the replicate. nullopt if the
    /// replicate has no value, is excluded, or its name is taken.
    std::map<int, std::optional<double>> goal_values;
    /// Total measured CPU time divided by the total estimated CPU time. The sums are over the records of this point
    /// that did not fail. If this point has no such record, the sums are over those of all points. 1 if there are none.
    double calibration = 1;
  };
  std::vector<Point> points;  ///< one element for each sweep point of the plan
  std::map<Flag, int> flags;  ///< number of replicates with each flag
  int lacking = 0;            ///< number of records that do not have all measures of the manifest
  /// replicates that have a checkpoint but no record
  std::vector<UnderWay> under_way;
  /// number of records from which the calibrations were computed
  int calibration_records = 0;
};

/// Surveys of a directory, one for each plan, and what they share.
struct Surveys {
  std::vector<Survey> of_plans;
  std::vector<std::string> unasked;  ///< names of the records that no plan requests
  /// one line for each file that is damaged or missing
  std::vector<std::string> damaged;
};

/// Makes surveys of a directory. It only reads files. A missing directory counts as empty. A record whose packing file
/// is damaged or missing counts as damaged. If the first plan keeps paths, this also holds for the path file. Damaged
/// records are not counted as recorded, because "isojam run" recomputes them. Throws FileError if a file cannot be read
/// at the moment.
Surveys surveys_of(const std::filesystem::path& directory, const std::vector<Plan>& plans);

}  // namespace isojam
