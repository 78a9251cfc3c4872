#pragma once

#include <cstdint>

#include "tasks/manifest/plan.hpp"

namespace isojam {

/// Estimated cost of a replicate.
struct Cost {
  double cpu_seconds = 0;
  double memory_bytes = 0;  ///< memory while the replicate runs, in addition to the memory of the program itself
  double disk_bytes = 0;    ///< size of the record, the packing, and the path if it is kept
};

/// Estimates the cost of a replicate. The estimate is a power of N for each solid. It was fitted to replicates with the
/// default protocol at N = 100 and 400 on two virtual cores of an AMD EPYC. The cost of compression increases if its
/// steps are shorter. The estimate is accurate to a factor of about two. On another machine or with another protocol,
/// all costs change by about the same factor, which can be found from existing records.
Cost estimated_cost(const ReplicateSpec& spec, bool keep_path);

/// Number of bytes that this process can still allocate before the memory of the machine, or of its control group, runs
/// out. 0 if this is unknown.
double available_memory();

/// Number of replicates that may be in memory at the same time, if each needs at most `largest` bytes. It is at least
/// one, and at most `threads`, because more would not be faster.
int replicates_in_flight(int threads, double largest, double available);

}  // namespace isojam
