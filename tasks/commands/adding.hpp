#pragma once

#include <stop_token>

#include "tasks/run/adding.hpp"
#include "tasks/system/console.hpp"

namespace isojam {

/// Numbers of records that were completed, and of records that were left as they were because the measurement failed.
struct AddingTally {
  std::size_t added = 0, left = 0;
};

/// Adds missing measures to records, in parallel as a run does, with a progress bar and a warning for each failure.
AddingTally add_measures(const Store& store, const Additions& additions, int threads, double memory_bytes,
                         const std::stop_token& stop, Console& console);

}  // namespace isojam
