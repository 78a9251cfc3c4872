#pragma once

#include <cstddef>
#include <optional>
#include <string>

namespace isojam {

/// One of `count` parts of a plan. Parts have no replicate in common and may share a directory.
struct Shard {
  int index = 0;  ///< from 0
  int count = 1;

  bool whole() const { return count == 1; }
  bool takes(std::size_t item) const {
    return item % static_cast<std::size_t>(count) == static_cast<std::size_t>(index);
  }
};

/// "I/N" with 1 ≤ I ≤ N ≤ 100000; nullopt for anything else.
std::optional<Shard> parse_shard(const std::string& text);

/// The shard of a Slurm array task, from its index and the array's least index, size and step. Outside of an array: the
/// whole plan. Throws std::invalid_argument if the variables contradict each other.
Shard shard_of_environment();

}  // namespace isojam
