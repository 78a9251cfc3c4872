#pragma once

#include <functional>
#include <optional>
#include <span>

#include "tasks/manifest/manifest.hpp"

namespace isojam {

/// Progress of a sweep point towards its goal.
struct Advance {
  /// number of replicates that must be recorded before the rule is checked again, or at which it ended
  int wanted = 0;
  /// true if no more replicates are needed: the goal or the maximum is reached, or none of the first `min` replicates
  /// has a value
  bool finished = false;
  bool met = false;                  ///< true if the requested half width was reached; false if there is no goal
  std::optional<double> half_width;  ///< half width at the last complete batch
};

/// Number of replicates at the end of the next batch: a quarter more than `replicates`, at least two more, and at most
/// `max`.
int next_batch_end(int replicates, int max);

/// Stopping rule. It is checked after `min` replicates and after every batch. A sweep point is finished if the 95 %
/// confidence interval (Student t) of the mean over its first n replicates is narrow enough for the goal. `values[r]`
/// is the value of replicate r; it is nullopt if the replicate failed, is excluded or has no value. `values` must end
/// before the first replicate that is not recorded. The rule uses replicates in the order of their numbers, so the
/// result does not depend on which replicate finished first. It is checked only after whole batches, because an
/// interval that is checked after each replicate reaches the goal by chance too often.
Advance advance_of(const Replicates& replicates, std::span<const std::optional<double>> values);

}  // namespace isojam
