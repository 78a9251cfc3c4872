#pragma once

#include <functional>
#include <map>
#include <optional>
#include <stop_token>
#include <string>
#include <string_view>
#include <vector>

#include "engine/solve/jam.hpp"
#include "tasks/manifest/plan.hpp"
#include "tasks/measure/measure.hpp"

namespace isojam {

/// The stage in which a replicate failed, and the reason.
struct Failure {
  std::string where;  ///< begin, jam, or the name of a measure
  std::string why;
};

/// Time that a replicate took. The CPU time is that of the threads that ran the stages, without the additional threads
/// of the pair loop.
struct Timing {
  double wall_seconds = 0, cpu_seconds = 0;
};

/// Complete result of one replicate.
struct Outcome {
  ReplicateSpec spec;
  JamResult jam;
  std::map<Measure, Measurement> measured;  ///< all requested measures, unless the replicate failed or was interrupted
  std::optional<Failure> failure;
  bool interrupted = false;
  Timing timing;
  std::map<std::string, double> stage_seconds;  ///< CPU time of each stage: jam, and every measure that was computed
};

/// State from which a replicate can be resumed: the progress of its run, and the time that it has taken so far.
struct Checkpoint {
  JamProgress progress;
  Timing spent;
};

/// The stages of a replicate, as functions without side effects. Several threads may call them at the same time.
struct Stages {
  /// Makes the state from which the run begins: randomly placed particles, or a state of a run that was interrupted.
  std::function<Checkpoint(const ReplicateSpec&)> begin;
  std::function<JamResult(const ReplicateSpec&, JamProgress, std::stop_token, const OnProgress&)> jam;
  std::function<Measurement(const ReplicateSpec&, Measure, const JamResult&)> measure;
};

/// The stages that call the engine.
Stages engine_stages();

/// The reason why a result of the stage jam has no jamming point; nullopt if it has one.
std::optional<Failure> failure_of(const JamResult& jam);

/// Names of the flags of an outcome without failure, in a fixed order. goal_not_reached: the decompression ended
/// farther from jamming than requested. not_balanced: states whose forces do not balance were accepted because of
/// minimiser.energy_change. outside_fit_window: fewer than two states are in the fit window, so φ_J was fitted to the
/// two states nearest jamming. Then follow the flags of the measures.
std::vector<std::string> flags_of(const Outcome& outcome);

}  // namespace isojam
