#pragma once

#include <cstddef>
#include <optional>
#include <string>

namespace isojam {

/// A shard: one of `count` parts of a plan. Each replicate belongs to exactly one shard. All shards may write to the
/// same results directory at the same time.
struct Shard {
  int index = 0;  ///< index of the shard, from 0
  int count = 1;

  bool whole() const { return count == 1; }
  /// True if the shard contains the replicate or sweep point with this index.
  bool takes(std::size_t item) const {
    return item % static_cast<std::size_t>(count) == static_cast<std::size_t>(index);
  }
};

/// Parses "I/N", which means shard I of N, counted from 1. Returns nullopt unless 1 ≤ I ≤ N ≤ 100000.
std::optional<Shard> parse_shard(const std::string& text);

/// The shard of this process if it is a task of a Slurm job array, from the environment variables SLURM_ARRAY_TASK_*.
/// For any other process, the shard is the whole plan. Throws std::invalid_argument if the variables do not describe an
/// array of evenly spaced tasks.
Shard shard_of_environment();

}  // namespace isojam
