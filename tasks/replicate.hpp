#pragma once

#include <functional>
#include <optional>
#include <stop_token>
#include <string>
#include <string_view>
#include <vector>

#include "engine/analysis/contacts.hpp"
#include "engine/solve/jam.hpp"
#include "tasks/plan.hpp"

namespace isojam {

/// Where and why a replicate failed.
struct Failure {
  std::string where;  ///< place, jam, contacts
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
  std::vector<ContactAnalysis> contacts;  ///< of each state of jam.states; empty if not measured
  std::optional<Failure> failure;
  bool interrupted = false;
  Timing timing;
};

using OnStep = std::function<void(const JamStep&)>;

/// The stages of a replicate. Values in, values out; the functions may be called from several threads at once.
struct Stages {
  std::function<Packing(const ReplicateSpec&)> place;
  std::function<JamResult(const ReplicateSpec&, Packing, std::stop_token, const OnStep&)> jam;
  std::function<std::vector<ContactAnalysis>(const ReplicateSpec&, const JamResult&)> contacts;
};

/// The engine's.
Stages engine_stages();

/// Why a result of jam is no jamming point; nullopt if it is one.
std::optional<Failure> failure_of(const JamResult& jam);

/// Reservations about an outcome without failure, in a fixed order: short_of_goal (expansion did not come as near to
/// jamming as asked), classes_undecided (a CDF fit in the nearest state gave no cut-off), crystalline (Q6 of its
/// contacts is above crystalline_q6).
std::vector<std::string_view> flags_of(const Outcome& outcome);

/// Index in jam.states of the state nearest jamming: the one of lowest density among those of positive energy.
/// Requires a result without failure.
std::size_t nearest_state(const JamResult& jam);

}  // namespace isojam
