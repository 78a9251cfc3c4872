#pragma once

#include <stop_token>

#include "tasks/io/console.hpp"
#include "tasks/run/additions.hpp"

namespace isojam {

/// Numbers of records to which measures were added, and of records that were not changed because a measure failed.
struct AddingTally {
  std::size_t added = 0, left = 0;
};

/// Adds missing measures to records, with the parallel flow graph of a run. Shows a progress bar, and prints a warning
/// for each failure.
AddingTally add_measures(const Store& store, const Additions& additions, int threads, double memory_bytes,
                         const std::stop_token& stop, Console& console);

}  // namespace isojam
