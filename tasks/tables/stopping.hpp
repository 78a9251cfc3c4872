#pragma once

#include <functional>
#include <optional>
#include <span>

#include "tasks/manifest/manifest.hpp"

namespace isojam {

/// How far a sweep point has come towards its goal.
struct Advance {
  int wanted = 0;         ///< replicates 0 … wanted − 1 are to be recorded; all there: the point is finished
  bool finished = false;  ///< the goal is met, or max reached, or none of the first min has a value: there is no hope
  bool met = false;       ///< the half width was reached; false without a goal
  std::optional<double> half_width;  ///< at the last batch that is complete
};

/// End of the batch after one that ended with `replicates`: a quarter more, at least two.
int next_batch_end(int replicates, int max);

/// Sequential rule: after min replicates, and after every batch, stop if the 95 % interval (Student t) of the mean over
/// replicates 0 … n − 1 is no wider than the goal asks. `values[r]` is that of replicate r, nullopt where it failed, is
/// excluded or has none; what stands beyond the first replicate that is not recorded must not be given. Decided in the
/// order of replicates, so the outcome does not depend on which was finished first. Batches, not single replicates,
/// since an interval looked at after each is met by chance too often.
Advance advance_of(const Replicates& replicates, std::span<const std::optional<double>> values);

}  // namespace isojam
