#pragma once

#include <functional>
#include <optional>
#include <stop_token>

#include "tasks/records/replicate.hpp"

namespace isojam {

struct GraphOptions {
  int threads = 0;    ///< number of threads; 0: all threads that the system allows this process
  int in_flight = 0;  ///< number of replicates in memory at the same time; 0: the number of threads
  std::stop_token stop;
  /// Called after every strain step of any replicate, from several threads at the same time. An exception stops the
  /// run.
  std::function<void(const ReplicateSpec&, const Checkpoint&)> on_step;
};

/// Returns the next replicate to run, or nullopt if there are no more. It is called by one thread at a time, and only
/// when another replicate can start. A plan of any length therefore needs no additional memory.
using NextReplicate = std::function<std::optional<ReplicateSpec>()>;

/// Runs all stages of every replicate, and passes one outcome of each replicate to `on_outcome`, one at a time, in any
/// order. An exception in a stage becomes the failure of the outcome. However, a resource failure (bad_alloc,
/// system_error, FileError) stops the run and is thrown from here. After a stop request, replicates that have not
/// started have no outcome, and running replicates have an interrupted outcome. An exception of `next`, `on_outcome` or
/// `on_step` stops the run and is thrown from here.
void run_graph(const NextReplicate& next, const Stages& stages, const GraphOptions& options,
               const std::function<void(const Outcome&)>& on_outcome);

/// Number of threads that the system allows this process.
int default_threads();

/// Runs `work` on the calling thread. Its parallel loops use at most `threads` threads, including the calling thread.
void with_threads(int threads, const std::function<void()>& work);

}  // namespace isojam
