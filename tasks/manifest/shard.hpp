#pragma once

#include <cstddef>
#include <optional>
#include <string>

namespace isojam {

/// One of `count` parts of a plan, which never touch the same replicate and may share a directory.
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

/// The shard of a Slurm array task, by its index and the array's least index, size and step of indices; the whole
/// outside of one. Throws std::invalid_argument where the variables contradict each other.
Shard shard_of_environment();

}  // namespace isojam
