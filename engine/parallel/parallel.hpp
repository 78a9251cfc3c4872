#pragma once

#include <cstddef>
#include <functional>
#include <span>

namespace isojam {

// Parallel loops of the engine, run by oneTBB. The function `run` is called once for each index. Rules:
// - Each call of `run` may write only to data that no other call uses, such as its own element of an array. The result
//   then depends neither on the number of threads nor on the order of the calls.
// - A thread that waits for the end of a loop runs only calls of the same loop, or of the same forest (see
//   for_each_in_forest()). It does not start another replicate, which might take an hour.
// - If the caller runs in a task of oneTBB that is cancelled, all calls are made nevertheless.
// - If a call throws an exception, calls that have not started may be skipped. The exception is rethrown when all
//   running calls have ended.

/// Calls run(k) for every k < count. Each call must take much longer than oneTBB needs to start a task. For shorter
/// calls, use for_each_small().
void for_each_index(std::size_t count, const std::function<void(std::size_t)>& run);

/// Calls run(k) for every k < count, if each call is short. One task makes small_calls_per_task calls. If each call
/// computes the overlap of one pair, a task takes about 50 µs. This is much longer than oneTBB needs to start a task,
/// and short enough to distribute the work evenly over the threads.
void for_each_small(std::size_t count, const std::function<void(std::size_t)>& run);
inline constexpr std::size_t small_calls_per_task = 128;

/// Calls run(k) for every k < count. Use it for a loop inside a call of for_each_in_forest(). While a thread waits for
/// the end of this loop, it may also run other calls of the forest. Other threads of the forest may run calls of this
/// loop.
void for_each_index_within(std::size_t count, const std::function<void(std::size_t)>& run);

/// Calls run(k) for every node k of a forest (a set of trees), after the calls for all children of k have returned
/// true. `parents[k]` is the parent of node k, or −1 if k is a root. Returns true if all calls returned true. After a
/// call has returned false, the function starts no further call. It waits for the end of running calls and returns
/// false.
bool for_each_in_forest(std::span<const int> parents, const std::function<bool(int)>& run);

}  // namespace isojam
