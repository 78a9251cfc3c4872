#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "tasks/manifest/manifest.hpp"
#include "tasks/measure/quantity.hpp"
#include "tasks/records/summary.hpp"
#include "tasks/tables/statistics.hpp"

namespace isojam {

/// Estimates of all_quantities(), in the same order.
using Estimates = std::vector<Estimate>;
inline Estimates no_estimates() { return Estimates(all_quantities().size()); }

/// Estimates at one distance to jamming. Quantities of replicates have no estimate here.
struct SeriesPoint {
  double delta_phi = 0;
  Estimates estimates = no_estimates(), all = no_estimates();  ///< the same as in Row
};

/// Progress of a sweep point towards the goal.
struct GoalOutcome {
  Goal goal;
  /// number of replicates at which the stopping rule ended; nullopt if it needs more replicates
  std::optional<int> needed;
  /// true if the goal is reached. False if the rule ended with an interval that is too wide, because the maximum was
  /// reached or no replicate has a value
  bool met = false;
  std::optional<double> half_width;  ///< half width at the last complete batch
};

/// Paired differences of a row from its base row. The base row has the same solid and number of particles, the values
/// in the base of the parameters that the base contains, and the values of this row of all other parameters. A pair
/// consists of a replicate of each row, with the same number and manifest. Both have the same initial configuration, so
/// most of the spread between packings cancels in the difference.
struct Differences {
  int pairs = 0;  ///< number of pairs in which no replicate failed or is excluded
  /// estimates of the value of this row minus the value of the base row, over the pairs in which both replicates have a
  /// value
  Estimates estimates = no_estimates();
};

/// One sweep point in a table.
// NOLINTNEXTLINE(bugprone-exception-escape): moving a Json is noexcept; the check sees its assertions throw.
struct Row {
  Mixture solid = SolidKind::tetrahedron;
  int particles = 0;
  Json parameters;     ///< values of the swept parameters other than solid and particles
  int replicates = 0;  ///< number of recorded replicates, including failed ones
  int failed = 0;
  int flagged = 0;   ///< number of replicates that did not fail but have a flag
  int excluded = 0;  ///< number of replicates with a flag that the table excludes
  /// estimates over the replicates that did not fail, are not excluded and have a value
  Estimates estimates = no_estimates();
  Estimates all = no_estimates();  ///< estimates that also include the excluded replicates
  /// estimates at those values of series_distances that lie between the states of a replicate
  std::vector<SeriesPoint> series;
  /// largest residual of the states that were used to fit φ_J; nullopt if all replicates failed
  std::optional<double> residual;
  std::optional<GoalOutcome> goal;
  /// differences from the base row; nullopt for the base row itself, and if there is no base
  std::optional<Differences> differences;
};

/// A table with rows sorted by solid, number of particles and parameters.
// NOLINTNEXTLINE(bugprone-exception-escape): as above.
struct Table {
  std::vector<Row> rows;
  std::vector<Flag> exclude;
  std::map<Flag, int> excluded;  ///< number of replicates with each excluded flag
  Json base = Json::object();    ///< the base: swept parameters and their values; empty if rows are not compared
  std::set<std::string> builds;  ///< builds of the program that made the records
};

/// Collects records one by one for a table. It keeps only the few kilobytes of each record that the table needs. The
/// result does not depend on the order of the records.
class Aggregation {
 public:
  /// Replicates with one of the flags in `exclude` are used only for the estimates over all replicates, and the
  /// stopping rule ignores them. Rows are compared with the base row, see base.hpp.
  explicit Aggregation(std::vector<Flag> exclude = usually_excluded(), Json base = Json::object())
      : exclude_(std::move(exclude)), base_(std::move(base)) {}

  /// Adds a record. A record that is added twice counts once. Throws InputError if records of one sweep point were made
  /// with different settings, or if two records of the same replicate differ.
  void add(const RecordSummary& record);

  /// Makes the table. `rule` is the number of replicates in the manifest. If it has a goal, every row reports the
  /// progress towards the goal.
  Table table(const std::optional<Replicates>& rule = std::nullopt) const;

 private:
  /// A value of a replicate. `quantity` is an index in all_quantities(). `place` is 0 for a value of the replicate or
  /// of its state nearest jamming, and k for a value at series_distances[k − 1].
  struct Cell {
    std::uint16_t quantity, place;
    double value;
  };
  struct Kept {
    std::string result_digest;
    bool failed = false, flagged = false, excluded = false;
    std::optional<double> residual;
    std::vector<Cell> cells;

    bool counts() const { return !failed && !excluded; }
  };
  using PointKey = std::tuple<Mixture, int, Json>;
  using ReplicateKey = std::pair<std::string, int>;  // manifest digest, replicate
  // NOLINTNEXTLINE(bugprone-exception-escape): as above.
  struct Point {
    Json settings;
    std::string first;  // the record from which they were taken
    std::map<ReplicateKey, Kept> replicates;
  };

  Kept kept(const RecordSummary& record) const;
  static Values own_values(const Kept& kept);  ///< values of the replicate and of its state nearest jamming
  static Row row(const PointKey& key, const Point& point, const std::optional<Replicates>& rule);
  std::optional<Differences> differences(const PointKey& key, const Point& point) const;
  static std::optional<GoalOutcome> goal_outcome(const Point& point, const std::optional<Replicates>& rule);

  std::vector<Flag> exclude_;
  std::map<Flag, int> excluded_;
  Json base_;
  std::map<PointKey, Point> points_;
  std::set<std::string> builds_;
};

/// Makes the table of several records.
Table aggregate(std::span<const RecordSummary> records, const std::optional<Replicates>& rule = std::nullopt,
                std::vector<Flag> exclude = usually_excluded(), Json base = Json::object());

}  // namespace isojam
