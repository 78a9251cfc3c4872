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
#include "tasks/replicate/summary.hpp"
#include "tasks/tables/statistics.hpp"

namespace isojam {

/// Estimates of all_quantities(), in their order.
using Estimates = std::vector<Estimate>;
inline Estimates no_estimates() { return Estimates(all_quantities().size()); }

/// Estimates at one distance above jamming. Quantities of replicates have none.
struct SeriesPoint {
  double delta_phi = 0;
  Estimates estimates = no_estimates(), all = no_estimates();  ///< as in Row
};

/// State of a sweep point with respect to the goal.
struct GoalOutcome {
  Goal goal;
  std::optional<int> needed;  ///< number of replicates at which the rule stopped; nullopt if it asks for more
  bool met = false;  ///< false if it stopped with too wide an interval, at max replicates or without any usable value
  std::optional<double> half_width;  ///< at the last complete batch
};

/// Differences of a row from its base. The base is the row with the same solid and particles, with the base's values of
/// the parameters that it names, and with this row's values of the others. Differences are taken over pairs of
/// replicates with the same number and manifest. These have the same initial configuration, so most of the spread
/// between packings cancels.
struct Differences {
  int pairs = 0;                         ///< pairs whose replicates neither failed nor are excluded
  Estimates estimates = no_estimates();  ///< of this row's value minus that of the base, over pairs in which both have
                                         ///< it
};

/// One sweep point.
// NOLINTNEXTLINE(bugprone-exception-escape): moving a Json is noexcept; the check sees its assertions throw.
struct Row {
  Mixture solid = SolidKind::tetrahedron;
  int particles = 0;
  Json parameters;     ///< the other swept values
  int replicates = 0;  ///< recorded replicates, including failed ones
  int failed = 0;
  int flagged = 0;                       ///< replicates that did not fail but have a flag
  int excluded = 0;                      ///< flagged replicates with a flag that the table excludes
  Estimates estimates = no_estimates();  ///< over replicates that neither failed nor are excluded and that have the
                                         ///< value
  Estimates all = no_estimates();        ///< the same, including excluded replicates
  std::vector<SeriesPoint> series;       ///< at those of series_distances that the states of a replicate enclose
  std::optional<double> residual;        ///< largest residual of the states behind φ_J; nullopt if all failed
  std::optional<GoalOutcome> goal;
  std::optional<Differences> differences;  ///< nullopt for the base itself, and without a base
};

/// Rows in order of solid, particles, parameters.
// NOLINTNEXTLINE(bugprone-exception-escape): as above.
struct Table {
  std::vector<Row> rows;
  std::vector<Flag> exclude;
  Json base = Json::object();    ///< swept parameters and their values; empty: no comparison
  std::set<std::string> builds;  ///< builds of the program that made the records
};

/// Collects records one by one and keeps only the few kilobytes of each that the table needs. The order does not
/// matter.
class Aggregation {
 public:
  /// Replicates with one of the `exclude` flags count only in the estimates over all replicates, and towards no goal.
  /// Rows are compared with the base, as described in base.hpp.
  explicit Aggregation(std::vector<Flag> exclude = usually_excluded(), Json base = Json::object())
      : exclude_(std::move(exclude)), base_(std::move(base)) {}

  /// A record that is added twice counts once. Throws InputError if records of one point were made with different
  /// settings, or if two records of the same replicate differ.
  void add(const RecordSummary& record);

  /// `rule` is the rule by which the records were made. With a goal, every row reports its progress towards it.
  Table table(const std::optional<Replicates>& rule = std::nullopt) const;

 private:
  /// A value of a replicate: index in all_quantities(), and its place: 0 for the replicate or its state nearest
  /// jamming, k for series_distances[k − 1].
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
  static Values own_values(const Kept& kept);  ///< of the replicate and of its state nearest jamming
  static Row row(const PointKey& key, const Point& point, const std::optional<Replicates>& rule);
  std::optional<Differences> differences(const PointKey& key, const Point& point) const;
  static std::optional<GoalOutcome> goal_outcome(const Point& point, const std::optional<Replicates>& rule);

  std::vector<Flag> exclude_;
  Json base_;
  std::map<PointKey, Point> points_;
  std::set<std::string> builds_;
};

/// The table of several records.
Table aggregate(std::span<const RecordSummary> records, const std::optional<Replicates>& rule = std::nullopt,
                std::vector<Flag> exclude = usually_excluded(), Json base = Json::object());

}  // namespace isojam
