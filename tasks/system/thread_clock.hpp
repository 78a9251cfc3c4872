#pragma once

#include <ctime>

namespace isojam {

/// CPU time that the calling thread has used, in seconds: what others on the machine do does not count.
inline double thread_cpu_seconds() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

}  // namespace isojam
