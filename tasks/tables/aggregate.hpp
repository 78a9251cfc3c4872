#pragma once

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
#include "tasks/tables/pooled_trough.hpp"
#include "tasks/tables/statistics.hpp"

namespace isojam {

/// Estimates of all_quantities(), in the same order.
using Estimates = std::vector<Estimate>;
inline Estimates no_estimates() { return Estimates(all_quantities().size()); }

/// Estimates at one distance to jamming. Quantities that have one value per replicate have no estimate here.
struct SeriesPoint {
  double delta_phi = 0;
  Estimates estimates = no_estimates(), all = no_estimates();  ///< without and with the excluded replicates, as in Row
  std::optional<PooledTrough> trough = std::nullopt;           ///< as in Row, of angles that are interpolated
};

/// Progress of a sweep point towards its goal.
struct GoalOutcome {
  Goal goal;
  /// number of replicates at which the stopping rule ended; nullopt if more replicates are needed
  std::optional<int> needed;
  /// True if the goal is reached. If the rule ended without the goal, the largest number of replicates was reached, or
  /// none of the first `min` replicates has a value.
  bool met = false;
  std::optional<double> half_width;  ///< half width of the confidence interval after the last complete batch
  std::vector<double> first;         ///< values whose standard deviation this interval uses, see Advance
};

/// Paired differences of a row from its base row, see base.hpp. A pair consists of two replicates with the same number
/// and manifest, one of each row. Both have the same initial configuration, so most of the spread between packings
/// cancels in the difference.
struct Differences {
  int pairs = 0;  ///< number of pairs in which no replicate failed or is excluded
  /// estimates of the value in this row minus the value in the base row, over the pairs in which both replicates have a
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
  int reached_limit = 0;  ///< number of replicates that failed because compression reached max_density
  int flagged = 0;        ///< number of replicates that did not fail but have a flag
  int excluded = 0;       ///< number of replicates that are excluded because of a flag
  /// estimates over the replicates that neither failed nor are excluded
  Estimates estimates = no_estimates();
  Estimates all = no_estimates();  ///< estimates over the replicates that did not fail, including the excluded ones
  /// troughs of the replicates that neither failed nor are excluded; nullopt if no record has histograms of angles
  std::optional<PooledTrough> trough;
  /// estimates at each value of series_distances that lies between two states of at least one replicate
  std::vector<SeriesPoint> series;
  /// largest residual of the states that were used to fit φ_J, over all replicates; nullopt if all replicates failed
  std::optional<double> residual;
  std::optional<GoalOutcome> goal;
  /// paired differences from the base row; nullopt for the base row itself, if the base is empty, and if the base has a
  /// parameter that was not swept for this row
  std::optional<Differences> differences;
};

/// A table with rows sorted by solid, number of particles and parameters.
// NOLINTNEXTLINE(bugprone-exception-escape): as above.
struct Table {
  std::vector<Row> rows;
  /// flags that exclude a replicate from means
  std::vector<Flag> exclude;
  std::map<Flag, int> excluded;  ///< number of replicates with each of these flags
  /// for each measure, the number of replicates for which only the nearest state was measured
  std::map<Measure, int> nearest_only;
  Json base = Json::object();    ///< the base, see base.hpp; if it is empty, no rows are compared
  std::set<std::string> builds;  ///< builds of the program that made the records or added measures to them
};

/// Collects records one by one for a table. For each record, it stores only the values that the table needs, which take
/// about half a kilobyte. The table does not depend on the order in which records are added.
class Aggregation {
 public:
  /// Replicates with a flag in `exclude` are excluded from means, and the stopping rule ignores their values. `base`
  /// selects the base rows, see base.hpp.
  explicit Aggregation(std::vector<Flag> exclude = usually_excluded(), Json base = Json::object())
      : exclude_(std::move(exclude)), base_(std::move(base)) {}
  ~Aggregation() = default;
  Aggregation(const Aggregation&) = delete;
  Aggregation& operator=(const Aggregation&) = delete;

  /// Adds a record. If a record is added twice, it counts once. Throws InputError if two records of a sweep point have
  /// different settings, or if two records of a replicate have different results.
  void add(const RecordSummary& record);

  /// Makes the table. `rule` is the number of replicates in the manifest. If it has a goal, every row states its
  /// progress towards the goal.
  Table table(const std::optional<Replicates>& rule = std::nullopt) const;

 private:
  /// Number of a value: place · number of quantities + index in all_quantities(). At place 0 are the values of the
  /// replicate and of its nearest state. At place k > 0 are the values at series_distances[k − 1].
  using Cell = std::uint16_t;
  using Cells = std::vector<Cell>;  ///< sorted
  /// The part of a record that the table needs.
  struct Kept {
    std::uint64_t result = 0;  ///< hash of the result digest
    bool failed = false, reached_limit = false, flagged = false, excluded = false;
    std::optional<double> residual;
    const Cells* cells = nullptr;  ///< the cells that have a value; most replicates of a study share them
    std::vector<double> values;    ///< a value for each cell

    bool counts() const { return !failed && !excluded; }
    std::optional<double> at(Cell cell) const;
  };
  using PointKey = std::tuple<Mixture, int, Json>;
  using ReplicateKey = std::pair<std::string, int>;  // RecordSummary::study, replicate
  // NOLINTNEXTLINE(bugprone-exception-escape): as above.
  struct Point {
    Json settings;
    std::string first;  // the record from which `settings` were taken
    std::map<ReplicateKey, Kept> replicates;
    std::map<std::size_t, PooledAngles> angles;  // by place, of the replicates that count
  };

  Kept kept(const RecordSummary& record);
  static Values own_values(const Kept& kept);  ///< values of the replicate and of its nearest state
  static void add_angles(const RecordSummary& record, Point& point);
  static std::optional<PooledTrough> trough(const PointKey& key, const Point& point, std::size_t place);
  /// Estimates of all quantities at a place, without and with the excluded replicates. `text` seeds the bootstrap.
  static void put_estimates(const Point& point, const std::string& text, std::size_t place, Estimates& estimates,
                            Estimates& all);
  static Row row(const PointKey& key, const Point& point, const std::optional<Replicates>& rule);
  std::optional<Differences> differences(const PointKey& key, const Point& point) const;
  static std::optional<GoalOutcome> goal_outcome(const Point& point, const std::optional<Replicates>& rule);

  std::vector<Flag> exclude_;
  std::map<Flag, int> excluded_;
  std::map<Measure, int> nearest_only_;
  Json base_;
  std::map<PointKey, Point> points_;
  std::set<Cells> layouts_;  ///< the distinct lists of cells
  std::set<std::string> builds_;
};

/// Makes a table of these records, see Aggregation.
Table aggregate(std::span<const RecordSummary> records, const std::optional<Replicates>& rule = std::nullopt,
                std::vector<Flag> exclude = usually_excluded(), Json base = Json::object());

}  // namespace isojam
