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

/// Where and why a replicate failed.
struct Failure {
  std::string where;  ///< begin, jam, or a measurement
  std::string why;
};

/// Cost of a replicate. CPU time is that of the thread that ran each stage, without helpers of the pair loop.
struct Timing {
  double wall_seconds = 0, cpu_seconds = 0;
};

/// All that came of one replicate.
struct Outcome {
  ReplicateSpec spec;
  JamResult jam;
  std::map<Measure, Measurement> measured;  ///< what the specification asks for, unless it failed or was interrupted
  std::optional<Failure> failure;
  bool interrupted = false;
  Timing timing;
  std::map<std::string, double> stage_seconds;  ///< CPU time by stage: jam, and every measurement that was made
};

/// State from which a replicate can be resumed: the progress of its run, and the time spent on it.
struct Checkpoint {
  JamProgress progress;
  Timing spent;
};

/// The stages of a replicate. Values in, values out; the functions may be called from several threads at once.
struct Stages {
  /// Where the run begins: with particles placed at random, or farther on.
  std::function<Checkpoint(const ReplicateSpec&)> begin;
  std::function<JamResult(const ReplicateSpec&, JamProgress, std::stop_token, const OnProgress&)> jam;
  std::function<Measurement(const ReplicateSpec&, Measure, const JamResult&)> measure;
};

/// The engine's.
Stages engine_stages();

/// Why a result of jam is no jamming point; nullopt if it is one.
std::optional<Failure> failure_of(const JamResult& jam);

/// Reservations about an outcome without failure, in a fixed order: goal_not_reached (expansion did not come as near to
/// jamming as asked), not_balanced (the rule on the energy let states pass whose forces do not balance),
/// outside_fit_window (fewer than two states lie in the window, so φ_J is of the two nearest), then those of the
/// measurements.
std::vector<std::string> flags_of(const Outcome& outcome);

}  // namespace isojam
