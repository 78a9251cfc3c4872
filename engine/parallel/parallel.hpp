#pragma once

#include <cstddef>
#include <functional>
#include <span>

namespace isojam {

// The threads of oneTBB, as the engine uses them. What is called may write to its own place only, so that a result
// depends neither on the number of threads nor on who did what. A thread that waits for the last calls starts nothing
// but calls of the same loop or forest: no replicate of its caller's, which might take an hour. Nobody else's
// cancellation makes calls be left out. What a call throws is thrown once none is under way; others may then have been
// left out.

/// Calls run(k) for every k < count.
void for_each_index(std::size_t count, const std::function<void(std::size_t)>& run);

/// The same from inside for_each_in_forest: a thread that waits here may start any other call of that forest, and the
/// threads of the forest may start these.
void for_each_index_within(std::size_t count, const std::function<void(std::size_t)>& run);

/// Calls run(k) for every node of a forest, after those of its children have returned true; `parents[k]` is another
/// node, or −1. False if one of them returned false: those that were not begun by then are left out, its ancestors in
/// any case.
bool for_each_in_forest(std::span<const int> parents, const std::function<bool(int)>& run);

}  // namespace isojam
