#pragma once

#include <stop_token>

#include "tasks/io/console.hpp"
#include "tasks/run/additions.hpp"

namespace isojam {

/// Number of records to which measures were added, and number of records that were left unchanged because of a problem.
struct AddingTally {
  std::size_t added = 0, unchanged = 0;
};

/// Adds measures to the records in `additions`, on `threads` threads. It shows the progress, and prints a warning for
/// each record that remains unchanged. `memory_bytes` is the available memory.
AddingTally add_measures(const Store& store, const Additions& additions, int threads, double memory_bytes,
                         const std::stop_token& stop, Console& console);

}  // namespace isojam
