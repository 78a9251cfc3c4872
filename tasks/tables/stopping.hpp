#pragma once

#include <optional>
#include <span>
#include <vector>

#include "tasks/manifest/manifest.hpp"

namespace isojam {

/// Progress of a sweep point towards its goal.
struct Advance {
  /// number of replicates at the next check of the rule; if `finished`, at the last check
  int wanted = 0;
  /// true if no more replicates are needed: the goal or the largest number of replicates is reached, or none of the
  /// first `min` replicates has a value
  bool finished = false;
  bool met = false;                  ///< true if the goal is reached; false if there is no goal
  std::optional<double> half_width;  ///< half width of the confidence interval after the last complete batch
  /// Values at the first check at which they are not all equal. Stein's interval uses their standard deviation. Empty
  /// if the quantity is a proportion, or if there is no goal.
  std::vector<double> first;
};

/// Number of replicates after the next batch. The size of a batch is a quarter of `replicates`, but at least two. The
/// result is at most `max`.
int next_batch_end(int replicates, int max);

/// The stopping rule of a sweep point. It is checked after the first `min` replicates and after every batch. The point
/// is finished if the 95 % confidence interval of the mean over all replicates so far is narrow enough for the goal.
/// The interval is Stein's, because Student's is narrow by chance too often when it is checked repeatedly. The interval
/// of a proportion is Wilson's. Except for a proportion, equal values meet no goal, because their spread is unknown.
/// `values[r]` is the value of replicate r; it is nullopt if the replicate failed, is excluded or has no value.
/// `values` must end before the first replicate that is not recorded. The result therefore does not depend on which
/// replicate finishes first.
Advance advance_of(const Replicates& replicates, std::span<const std::optional<double>> values);

}  // namespace isojam
