#pragma once

#include <utility>
#include <vector>

#include "tasks/run/graph.hpp"
#include "tests/tasks/support/bad_manifests.hpp"
#include "tests/tasks/support/support.hpp"

namespace isojam::test {

inline std::vector<ReplicateSpec> plan_of(int replicates) {
  auto manifest = good_manifest();
  manifest["replicates"] = replicates;
  return make_plan(parse_manifest(manifest.dump(), "m"));
}

/// Returns the specifications, one after the other.
inline NextReplicate one_by_one(std::vector<ReplicateSpec> specs) {
  return [specs = std::move(specs), at = std::size_t{0}]() mutable {
    return at < specs.size() ? std::optional(specs[at++]) : std::nullopt;
  };
}

/// Stages that return artificial results without any computation.
inline Stages quiet_stages() {
  return {[](const ReplicateSpec& spec) {
            return Checkpoint{begin_jam(made_up_outcome(spec).jam.states.front(), spec.options), {}};
          },
          [](const ReplicateSpec& spec, const JamProgress&, std::stop_token, const OnProgress&) {
            return made_up_outcome(spec).jam;
          },
          [](const ReplicateSpec& spec, Measure what, const JamResult&) {
            return made_up_outcome(spec).measured.at(what);
          }};
}

}  // namespace isojam::test
