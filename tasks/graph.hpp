#pragma once

#include <functional>
#include <span>
#include <stop_token>

#include "tasks/replicate.hpp"

namespace isojam {

struct GraphOptions {
  int threads = 0;  ///< 0: as many as the machine gives this process
  std::stop_token stop;
  /// Called after every minimised step of any replicate, from several threads at once.
  std::function<void(const ReplicateSpec&, const JamStep&)> on_step;
};

/// Runs every replicate through the stages and hands exactly one outcome of each to `on_outcome`, one at a time, in
/// no particular order. An exception in a stage becomes the outcome's failure. After a stop request, replicates that
/// have not started give no outcome and those under way give an interrupted one. An exception of `on_outcome` stops
/// the run and is thrown from here.
void run_graph(std::span<const ReplicateSpec> plan, const Stages& stages, const GraphOptions& options,
               const std::function<void(const Outcome&)>& on_outcome);

}  // namespace isojam
