#include "tasks/commands/adding.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "tasks/json/input_error.hpp"
#include "tasks/manifest/cost.hpp"
#include "tasks/run/graph.hpp"

namespace isojam {
namespace {

/// True if the record has now what was measured.
bool add_one(const Store& store, const Outcome& outcome, Console& console) {
  const auto name = replicate_name(outcome.spec);
  if (outcome.failure) {
    console.warn(fmt::format("{} failed in {}: {}; its record is as it was", name, outcome.failure->where,
                             outcome.failure->why));
    return false;
  }
  try {
    const auto before = read_record(store.directory(), name);
    store.write_added(outcome, before, has_moved(outcome.jam, before));
    return true;
  } catch (const InputError& error) {
    console.warn(fmt::format("{}; its record is as it was", error.what()));
    return false;
  }
}

}  // namespace

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
  const NextReplicate next = [&, at = std::size_t{0}]() mutable {
    return at < count ? std::optional(additions.measured[at++]) : std::nullopt;
  };
  const GraphOptions options{threads, replicates_in_flight(threads, largest, memory_bytes), stop, {}};
  run_graph(next, adding_stages(store.directory()), options, [&](const Outcome& outcome) {
    if (outcome.interrupted) return;
    const bool added = add_one(store, outcome, console);
    ++(added ? tally.added : tally.left);
    console.finished(estimated_cost(outcome.spec, false).cpu_seconds, !added);
    console.tick(replicate_name(outcome.spec));
  });
  console.end();
  return tally;
}

}  // namespace isojam
