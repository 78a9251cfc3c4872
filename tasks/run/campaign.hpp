#pragma once

#include <functional>
#include <optional>
#include <set>
#include <stop_token>
#include <string>
#include <vector>

#include "tasks/manifest/cost.hpp"
#include "tasks/manifest/shard.hpp"
#include "tasks/records/store.hpp"
#include "tasks/tables/stopping.hpp"

namespace isojam {

/// The replicates of a study that a shard has to run, in rounds.
///
/// Without a goal there is one round, and each shard gets single replicates of the plan. With a goal, a round contains
/// the next batch of replicates of every sweep point that has not reached the goal. The batch of a point depends only
/// on the recorded replicates of its earlier batches. Each shard then gets whole sweep points, because a shard cannot
/// wait for results of another one.
///
/// The object stores a few numbers for each sweep point. With a goal, it also stores one value for each replicate.
class Campaign {
 public:
  Campaign(const Plan& plan, const Replicates& rule, const Shard& shard, const Store& store);

  /// Begins the next round. Before the call, all replicates that next() returned must be in the records. Returns false
  /// if there are no more rounds. With a goal, throws FileError if one of these records was removed or damaged.
  bool open_round();
  /// The next replicate of the round that has no valid record. It is locked, see Store::take(). Replicates that another
  /// process computes come last: the function waits until they are recorded, or until that process has ended. nullopt
  /// if the round has no more such replicates, or after a stop request.
  std::optional<ReplicateSpec> next(const std::stop_token& stop = {});

  struct Size {
    std::size_t replicates = 0;  ///< number of replicates of this shard in the round
    /// number of these replicates that have a record file, valid or not
    std::size_t recorded = 0;
    double work = 0;  ///< estimated CPU seconds of the replicates that have no record file
  };
  Size round_size() const;
  /// Estimated memory, in bytes, of the replicate of the plan that needs the most memory.
  double largest_memory() const;
  /// Names of the replicates in all rounds so far for which `has` returns false, without those whose name was taken.
  std::vector<std::string> without(const std::function<bool(const std::string&)>& has) const;
  /// Number of failed replicates among the valid records that next() skipped, and of replicates whose name was taken.
  int failed() const { return failed_; }

 private:
  struct Point {
    /// number of replicates in all earlier rounds, and number in all rounds up to the present one
    int done = 0, wanted = 0;
    /// values of the quantity of the goal in all earlier rounds; nullopt if a replicate has no value or is excluded
    std::vector<std::optional<double>> values;
  };

  bool takes(std::size_t point, int replicate) const;
  std::optional<ReplicateSpec> next_in_order();
  bool is_missing(ReplicateSpec& spec);
  void learn(std::size_t point);

  const Plan& plan_;
  Replicates rule_;
  Shard shard_;
  const Store& store_;
  std::vector<Point> points_;
  std::size_t at_point_ = 0;
  int at_replicate_ = 0;
  std::vector<ReplicateSpec> elsewhere_;  ///< replicates of the round that other processes compute
  int failed_ = 0;
  std::set<std::string> taken_;  ///< names that records with other specifications have, see Store::recorded()
};

}  // namespace isojam
