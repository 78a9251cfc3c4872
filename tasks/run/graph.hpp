#pragma once

#include <functional>
#include <optional>
#include <stop_token>

#include "tasks/replicate/replicate.hpp"

namespace isojam {

struct GraphOptions {
  int threads = 0;    ///< 0: as many as the machine gives this process
  int in_flight = 0;  ///< replicates in memory at once; 0: as many as threads
  std::stop_token stop;
  /// Called after every minimised step of any replicate, from several threads at once. An exception from it stops the
  /// run.
  std::function<void(const ReplicateSpec&, const Checkpoint&)> on_step;
};

/// The replicates to run, one by one; nullopt when there are no more. Called by one thread at a time, and only when
/// there is room for another: a plan of any length takes no memory.
using NextReplicate = std::function<std::optional<ReplicateSpec>()>;

/// Runs every replicate through the stages and hands exactly one outcome of each to `on_outcome`, one at a time, in no
/// particular order. An exception in a stage becomes the outcome's failure. A resource failure (bad_alloc,
/// system_error, FileError) instead stops the run and is thrown from here. After a stop request, replicates that have
/// not started give no outcome and those under way give an interrupted one. An exception of `next`, `on_outcome` or
/// `on_step` stops the run and is thrown from here.
void run_graph(const NextReplicate& next, const Stages& stages, const GraphOptions& options,
               const std::function<void(const Outcome&)>& on_outcome);

/// As many threads as the machine gives this process.
int default_threads();

/// Runs `work` on the calling thread; whatever it does in parallel takes `threads` at most, this one among them.
void with_threads(int threads, const std::function<void()>& work);

}  // namespace isojam
