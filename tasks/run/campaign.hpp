#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "tasks/manifest/cost.hpp"
#include "tasks/manifest/shard.hpp"
#include "tasks/records/store.hpp"
#include "tasks/tables/stopping.hpp"

namespace isojam {

/// The replicates of a study that a shard still has to run, in rounds. Without a goal there is one round, and each
/// shard gets single replicates of the plan. With a goal, a round contains the next batch of replicates of every sweep
/// point that has not reached the goal. This is decided only from the recorded replicates of earlier batches of the
/// same point. Each shard then gets whole sweep points, because a shard cannot wait for another one. The object stores
/// a few numbers per sweep point. Per replicate, it stores only the value to which a goal applies.
class Campaign {
 public:
  Campaign(const Plan& plan, const Replicates& rule, const Shard& shard, const Store& store);

  /// Begins the next round. All replicates that next() returned must have been recorded. Returns false if no round is
  /// left.
  bool open_round();
  /// The next replicate of the round that has no valid record; nullopt if the round has no more replicates.
  std::optional<ReplicateSpec> next();

  struct Size {
    std::size_t replicates = 0;  ///< number of replicates of this shard in the round, with or without record
    /// number of these replicates that have a record file; only next() checks whether it is valid
    std::size_t recorded = 0;
    double work = 0;  ///< estimated CPU seconds of the replicates without a record file
  };
  Size round_size() const;
  /// Largest estimated memory of a replicate of the plan.
  double largest_memory() const;
  /// Names of the replicates of all rounds so far for which `has` returns false.
  std::vector<std::string> without(const std::function<bool(const std::string&)>& has) const;
  /// Number of failed replicates among the valid records that next() skipped.
  int failed() const { return failed_; }

 private:
  struct Point {
    /// number of replicates of all earlier rounds, and of all rounds including the present one
    int done = 0, wanted = 0;
    std::vector<std::optional<double>> values;
  };

  bool takes(std::size_t point, int replicate) const;
  void learn(std::size_t point);

  const Plan& plan_;
  Replicates rule_;
  Shard shard_;
  const Store& store_;
  std::vector<Point> points_;
  std::size_t at_point_ = 0;
  int at_replicate_ = 0;
  int failed_ = 0;
};

}  // namespace isojam
