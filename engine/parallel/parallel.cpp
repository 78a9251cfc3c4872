#include "engine/parallel/parallel.hpp"

#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/partitioner.h>
#include <oneapi/tbb/task_arena.h>
#include <oneapi/tbb/task_group.h>

#include <algorithm>
#include <atomic>
#include <vector>

namespace isojam {

void for_each_index(std::size_t count, const std::function<void(std::size_t)>& run) {
  if (count == 1) return run(0);
  tbb::this_task_arena::isolate([&] { for_each_index_within(count, run); });
}

void for_each_small(std::size_t count, const std::function<void(std::size_t)>& run) {
  for_each_index((count + small_calls_per_task - 1) / small_calls_per_task, [&](std::size_t task) {
    const std::size_t end = std::min(count, (task + 1) * small_calls_per_task);
    for (std::size_t k = task * small_calls_per_task; k < end; ++k) run(k);
  });
}

void for_each_index_within(std::size_t count, const std::function<void(std::size_t)>& run) {
  // Isolated context: cancelling the caller's context would silently skip iterations.
  tbb::task_group_context own(tbb::task_group_context::isolated);
  tbb::parallel_for(std::size_t{0}, count, run, own);
}

bool for_each_in_forest(std::span<const int> parents, const std::function<bool(int)>& run) {
  std::vector<std::atomic<int>> waiting_for(parents.size());  // children
  for (const int parent : parents) {
    if (parent >= 0) ++waiting_for[parent];
  }
  std::vector<int> leaves;
  for (std::size_t k = 0; k < parents.size(); ++k) {
    if (waiting_for[k] == 0) leaves.push_back(static_cast<int>(k));
  }
  std::atomic<bool> refused = false;
  // The thread that finishes the last child continues with the parent; no thread blocks.
  const auto climb = [&](std::size_t leaf) {
    for (int k = leaves[leaf]; k >= 0; k = parents[k]) {
      if (refused) return;
      if (!run(k)) refused = true;
      if (parents[k] >= 0 && --waiting_for[parents[k]] > 0) return;
    }
  };
  tbb::this_task_arena::isolate([&] {
    tbb::task_group_context own(tbb::task_group_context::isolated);
    // Grain size 1, because the work per leaf varies widely.
    tbb::parallel_for(
        tbb::blocked_range<std::size_t>(0, leaves.size(), 1),
        [&](const tbb::blocked_range<std::size_t>& range) {
          for (std::size_t leaf = range.begin(); leaf != range.end(); ++leaf) climb(leaf);
        },
        tbb::simple_partitioner(), own);
  });
  return !refused;
}

}  // namespace isojam
