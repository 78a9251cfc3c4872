#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "tasks/manifest/cost.hpp"
#include "tasks/manifest/shard.hpp"
#include "tasks/store/store.hpp"
#include "tasks/tables/stopping.hpp"

namespace isojam {

/// The replicates that a shard of a plan still has to run, round by round. Without a goal there is one round, and
/// replicates are dealt to shards one by one. With a goal a round is the next batch of every sweep point that has not
/// met it, decided by what is recorded of that point's earlier batches alone; whole points are dealt to shards, since
/// one shard cannot wait for another. Holds a few numbers per sweep point, and nothing per replicate but the values
/// that a goal looks at.
class Campaign {
 public:
  Campaign(const Plan& plan, const Replicates& rule, const Shard& shard, const Store& store);

  /// Opens the next round, once all that next() gave is recorded. False if there is none: all is done.
  bool open_round();
  /// The next replicate of the round without a valid record; nullopt when the round has no more.
  std::optional<ReplicateSpec> next();

  struct Size {
    std::size_t replicates = 0;  ///< of this shard in the round, recorded or not
    std::size_t recorded = 0;    ///< that have a file of a record; whether it is valid is seen by next()
    double work = 0;             ///< estimated CPU seconds of those that have none
  };
  Size round_size() const;
  /// Largest memory that a replicate of the plan is expected to take.
  double largest_memory() const;
  /// Names of the replicates of all rounds so far of which `has` is false.
  std::vector<std::string> without(const std::function<bool(const std::string&)>& has) const;
  /// Failures among the valid records that next() passed over.
  int failed() const { return failed_; }

 private:
  struct Point {
    int done = 0, wanted = 0;  ///< replicates of earlier rounds, and of these and this one
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
