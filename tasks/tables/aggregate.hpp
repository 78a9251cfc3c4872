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

/// How a row differs from its base: from the row of the same solid and particles that has the base's values of the
/// parameters that it names, and this row's own of the others. Taken over pairs of replicates, of one number and one
/// manifest, which began alike, so that most of the spread between packings cancels.
struct Differences {
  int pairs = 0;                         ///< whose replicates neither failed nor are excluded
  Estimates estimates = no_estimates();  ///< of this row's value less that of the base, over pairs that both have it
};

/// One sweep point.
// NOLINTNEXTLINE(bugprone-exception-escape): moving a Json is noexcept; the check sees its assertions throw.
struct Row {
  Mixture solid = SolidKind::tetrahedron;
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
  std::optional<Differences> differences;  ///< nullopt for the base itself, and where there is none
};

/// Rows in order of solid, particles, parameters.
// NOLINTNEXTLINE(bugprone-exception-escape): as above.
struct Table {
  std::vector<Row> rows;
  std::vector<Flag> exclude;
  Json base = Json::object();    ///< swept parameters and their values; empty: no row is compared with another
  std::set<std::string> builds;  ///< of the program, that made the records
};

/// Gathers records one by one and keeps of each only what the table needs: a few kilobytes. The order does not matter.
class Aggregation {
 public:
  /// Replicates with one of these flags count in no estimate but those of all, and towards no goal. Rows are compared
  /// with that of the base, as base.hpp describes it.
  explicit Aggregation(std::vector<Flag> exclude = usually_excluded(), Json base = Json::object())
      : exclude_(std::move(exclude)), base_(std::move(base)) {}

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

    bool counts() const { return !failed && !excluded; }
  };
  using PointKey = std::tuple<Mixture, int, Json>;
  using ReplicateKey = std::pair<std::string, int>;  // manifest digest, replicate
  // NOLINTNEXTLINE(bugprone-exception-escape): as above.
  struct Point {
    Json settings;
    std::string first;  // the record that gave them
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

/// The table of several records at once.
Table aggregate(std::span<const RecordSummary> records, const std::optional<Replicates>& rule = std::nullopt,
                std::vector<Flag> exclude = usually_excluded(), Json base = Json::object());

}  // namespace isojam
