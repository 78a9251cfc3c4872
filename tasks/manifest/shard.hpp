#pragma once

#include <cstddef>
#include <optional>
#include <string>

namespace isojam {

/// A shard: one of `count` parts of a plan. Each replicate belongs to exactly one part. All parts may write to the same
/// directory.
struct Shard {
  int index = 0;  ///< index of the part, from 0
  int count = 1;

  bool whole() const { return count == 1; }
  bool takes(std::size_t item) const {
    return item % static_cast<std::size_t>(count) == static_cast<std::size_t>(index);
  }
};

/// Parses "I/N" with 1 ≤ I ≤ N ≤ 100000. nullopt for any other text.
std::optional<Shard> parse_shard(const std::string& text);

/// The shard of a task of a Slurm job array, from the environment variables with the index of the task and the smallest
/// index, size and step of the array. If the process is not such a task, the whole plan. Throws std::invalid_argument
/// if the variables contradict each other.
Shard shard_of_environment();

}  // namespace isojam
