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

/// Estimates at one distance above jamming; those of replicates are empty.
struct SeriesPoint {
  double delta_phi = 0;
  Estimates estimates = no_estimates(), all = no_estimates();  ///< as those of the row
};

/// How far a sweep point came towards a goal.
struct GoalOutcome {
  Goal goal;
  std::optional<int> needed;         ///< replicates after which the rule stopped; nullopt if it asks for more
  bool met = false;                  ///< false if it stopped too wide, at max replicates or where there is no hope
  std::optional<double> half_width;  ///< at the last batch that is complete
};

/// One sweep point.
// NOLINTNEXTLINE(bugprone-exception-escape): moving a Json is noexcept; the check sees its assertions throw.
struct Row {
  SolidKind solid = SolidKind::tetrahedron;
  int particles = 0;
  Json parameters;     ///< the other swept values
  int replicates = 0;  ///< recorded, the failed ones included
  int failed = 0;
  int flagged = 0;                       ///< did not fail, but their records hold a reservation
  int excluded = 0;                      ///< of these, those with a flag that the table excludes
  Estimates estimates = no_estimates();  ///< over replicates that neither failed nor are excluded and have the value
  Estimates all = no_estimates();        ///< the same with the excluded replicates
  std::vector<SeriesPoint> series;       ///< at those of series_distances that a replicate's states enclose
  std::optional<double> residual;        ///< worst of the states behind φ_J; nullopt if all failed
  std::optional<GoalOutcome> goal;
};

/// Rows in order of solid, particles, parameters.
struct Table {
  std::vector<Row> rows;
  std::vector<Flag> exclude;
  std::set<std::string> builds;  ///< of the program, that made the records
};

/// Gathers records one by one and keeps of each only what the table needs: a few kilobytes. The order does not matter.
class Aggregation {
 public:
  /// Replicates with one of these flags count in no estimate but those of all, and towards no goal.
  explicit Aggregation(std::vector<Flag> exclude = usually_excluded()) : exclude_(std::move(exclude)) {}

  /// A record that is given twice counts once. Throws InputError if records of one point were made with different
  /// settings, or if two records of the same replicate disagree.
  void add(const RecordSummary& record);

  /// `rule` is what the records were made by; with a goal, every row says how far it came.
  Table table(const std::optional<Replicates>& rule = std::nullopt) const;

 private:
  /// A value of a replicate: which of all_quantities(), and where: 0 its own or that of its nearest state, k at
  /// series_distances[k − 1].
  struct Cell {
    std::uint16_t quantity, place;
    double value;
  };
  struct Kept {
    std::string result_digest;
    bool failed = false, flagged = false, excluded = false;
    std::optional<double> residual;
    std::vector<Cell> cells;
  };
  using PointKey = std::tuple<SolidKind, int, Json>;
  using ReplicateKey = std::pair<std::string, int>;  // manifest digest, replicate
  // NOLINTNEXTLINE(bugprone-exception-escape): as above.
  struct Point {
    Json settings;
    std::string first;  // the record that gave them
    std::map<ReplicateKey, Kept> replicates;
  };

  Kept kept(const RecordSummary& record) const;
  static Row row(const PointKey& key, const Point& point, const std::optional<Replicates>& rule);
  static std::optional<GoalOutcome> goal_outcome(const Point& point, const std::optional<Replicates>& rule);

  std::vector<Flag> exclude_;
  std::map<PointKey, Point> points_;
  std::set<std::string> builds_;
};

/// The table of several records at once.
Table aggregate(std::span<const RecordSummary> records, const std::optional<Replicates>& rule = std::nullopt,
                std::vector<Flag> exclude = usually_excluded());

}  // namespace isojam
