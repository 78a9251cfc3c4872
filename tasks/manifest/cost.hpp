#pragma once

#include <cstdint>

#include "tasks/manifest/plan.hpp"

namespace isojam {

/// Estimated cost of a replicate.
struct Cost {
  double cpu_seconds = 0;
  double memory_bytes = 0;  ///< while it runs, in addition to the memory of the program itself
  double disk_bytes = 0;    ///< record, packing, and the path if it is kept
};

/// Cost of a replicate, estimated from replicates with the default protocol at N = 100 and 400 (two virtual cores of an
/// AMD EPYC). It is a power of N for each solid. The share of the consolidation grows as its steps shrink. Accurate to
/// a factor of about two; another machine or protocol changes all costs by a common factor, which existing records can
/// show.
Cost estimated_cost(const ReplicateSpec& spec, bool keep_path);

/// Bytes that this process may still allocate before the machine or its control group runs out of memory. 0 if this is
/// unknown.
double available_memory();

/// Number of replicates of at most `largest` bytes each that may be in memory at once. At least one, and at most
/// `threads`, because more would not be faster.
int replicates_in_flight(int threads, double largest, double available);

}  // namespace isojam
