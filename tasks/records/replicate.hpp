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
  std::string where;  ///< "begin", "jam", or the name of a measure
  std::string why;
};

/// Time that a replicate took. The CPU time contains only the threads that ran the stages. It does not contain the
/// additional threads of the pair loop.
struct Timing {
  double wall_seconds = 0, cpu_seconds = 0;

  friend Timing operator+(const Timing& a, const Timing& b) {
    return {a.wall_seconds + b.wall_seconds, a.cpu_seconds + b.cpu_seconds};
  }
};

/// Result of one replicate, also of a failed or interrupted one.
struct Outcome {
  ReplicateSpec spec;
  JamResult jam;
  /// results of the measures that were computed: all requested ones, unless the replicate failed or was interrupted
  std::map<Measure, Measurement> measured;
  std::optional<Failure> failure;
  bool interrupted = false;
  Timing timing;
  std::map<std::string, double> stage_seconds;  ///< CPU time of the stage "jam" and of every measure that was computed
};

/// Progress from which a replicate can be resumed, and the time that the replicate has taken so far.
struct Checkpoint {
  JamProgress progress;
  Timing spent;
};

/// The stages of a replicate, as functions. Several threads may call them at the same time.
struct Stages {
  /// Makes the progress with which the run begins, from the initial configuration or from a checkpoint.
  std::function<Checkpoint(const ReplicateSpec&)> begin;
  /// Compresses and decompresses the packing. Then relaxes saddles to minima if a measure needs minima.
  std::function<JamResult(const ReplicateSpec&, JamProgress, std::stop_token, const OnProgress&)> jam;
  /// Computes one measure.
  std::function<Measurement(const ReplicateSpec&, Measure, const JamResult&)> measure;
};

/// Options of the measures of a replicate, with the cohesion that acts in its states.
MeasureOptions measure_options(const ReplicateSpec& spec);

/// The stages that call the engine and have no side effects.
Stages engine_stages();

/// The reason why a result of the stage "jam" counts as a failure; nullopt if it does not.
std::optional<Failure> failure_of(const JamResult& jam);

/// The flags of an outcome without failure, in a fixed order: first goal_not_reached, not_balanced and
/// outside_fit_window, then the flags of the measures.
std::vector<Flag> flags_of(const Outcome& outcome);

}  // namespace isojam
