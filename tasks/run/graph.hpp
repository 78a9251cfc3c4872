#pragma once

#include <functional>
#include <optional>
#include <stop_token>

#include "tasks/records/replicate.hpp"

namespace isojam {

struct GraphOptions {
  int threads = 0;    ///< number of threads; 0 means all threads that the system allows this process
  int in_flight = 0;  ///< largest number of replicates in memory at the same time; 0 means the number of threads
  std::stop_token stop;
  /// Called after every strain step of every replicate. Several threads may call it at the same time. If it throws an
  /// exception, the run stops.
  std::function<void(const ReplicateSpec&, const Checkpoint&)> on_step;
};

/// Returns the next replicate to run, or nullopt if there are no more. It is called by one thread at a time. It is not
/// called again while a few returned replicates still wait for their start. The memory therefore does not depend on the
/// number of replicates.
using NextReplicate = std::function<std::optional<ReplicateSpec>()>;

/// Runs all stages of every replicate, and passes one outcome for each replicate to `on_outcome`, one at a time, in any
/// order. If a stage throws an exception, the replicate fails and the run continues. However, a resource failure (see
/// is_resource_failure()) stops the run, and run_graph() throws it. The same is true for an exception of `next`,
/// `on_outcome` or `on_step`. After a stop request, no further replicate starts, and the outcomes of running replicates
/// are marked as interrupted, unless all their stages have ended.
void run_graph(const NextReplicate& next, const Stages& stages, const GraphOptions& options,
               const std::function<void(const Outcome&)>& on_outcome);

/// Number of threads that the system allows this process.
int default_threads();

/// Runs `work` on the calling thread. Parallel loops in `work` use at most `threads` threads, including the calling
/// thread.
void with_threads(int threads, const std::function<void()>& work);

}  // namespace isojam
