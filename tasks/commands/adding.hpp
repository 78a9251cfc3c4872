#pragma once

#include <stop_token>

#include "tasks/run/adding.hpp"
#include "tasks/system/console.hpp"

namespace isojam {

/// How many records were added to, and how many are as they were because it failed.
struct AddingTally {
  std::size_t added = 0, left = 0;
};

/// Adds to records what they lack, in parallel as a run does, with a bar and a warning for each that fails.
AddingTally add_measures(const Store& store, const Additions& additions, int threads, double memory_bytes,
                         const std::stop_token& stop, Console& console);

}  // namespace isojam
