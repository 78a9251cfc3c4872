#pragma once

#include <cstddef>
#include <functional>
#include <span>

namespace isojam {

// Parallel loops of the engine, run by oneTBB. Each call may write only to its own slot, so results depend neither on
// the number of threads nor on the schedule. A thread that waits for the last calls starts only calls of the same loop
// or forest; it does not start another replicate, which might take an hour. Cancellation elsewhere does not skip calls.
// An exception from a call is rethrown when no call is running any more; calls that had not started by then may be
// skipped.

/// Calls run(k) for every k < count.
void for_each_index(std::size_t count, const std::function<void(std::size_t)>& run);

/// The same loop, called from inside for_each_in_forest: a thread that waits here may start any other call of that
/// forest, and the threads of the forest may start calls of this loop.
void for_each_index_within(std::size_t count, const std::function<void(std::size_t)>& run);

/// Calls run(k) for every node k of a forest, after the calls of all its children have returned true. `parents[k]` is
/// another node, or −1 for a root. Returns false if a call returned false: the ancestors of its node are then skipped,
/// and so is every other node that had not started.
bool for_each_in_forest(std::span<const int> parents, const std::function<bool(int)>& run);

}  // namespace isojam
