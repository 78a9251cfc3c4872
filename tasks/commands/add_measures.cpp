#include "tasks/commands/add_measures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "tasks/manifest/cost.hpp"
#include "tasks/run/graph.hpp"

namespace isojam {
AddingTally add_measures(const Store& store, const Additions& additions, int threads, double memory_bytes,
                         const std::stop_token& stop, Console& console) {
  AddingTally tally;
  for (const auto& spec : additions.failed) {
    store.write_added(spec, read_record(store.directory(), replicate_name(spec)));
    ++tally.added;
  }
  const auto count = additions.measured.size();
  double work = 0, largest = 0;
  for (const auto& spec : additions.measured) {
    const auto cost = estimated_cost(spec, false);
    work += cost.cpu_seconds;
    largest = std::max(largest, cost.memory_bytes);
  }
  console.begin(static_cast<int>(count), work);
  const NextReplicate next = [&, next_index = std::size_t{0}]() mutable {
    return next_index < count ? std::optional(additions.measured[next_index++]) : std::nullopt;
  };
  const GraphOptions options{threads, replicates_in_flight(threads, largest, memory_bytes), stop, {}};
  Adder adder(store, additions.measured);
  run_graph(next, adder.stages(), options, [&](const Outcome& outcome) {
    if (outcome.interrupted) return;
    const auto problem = adder.finish(outcome);
    if (problem) console.warn(fmt::format("{}; the record of {} is unchanged", *problem, replicate_name(outcome.spec)));
    ++(problem ? tally.unchanged : tally.added);
    console.finished(estimated_cost(outcome.spec, false).cpu_seconds, problem.has_value());
    console.tick(replicate_name(outcome.spec));
  });
  console.end();
  return tally;
}

}  // namespace isojam
