#pragma once

#include <cstdlib>
#include <string>

namespace isojam::test {

#if defined(__SANITIZE_ADDRESS__)
/// the sanitizer replaces the same functions as the preloaded library, so the two cannot be combined
inline constexpr bool with_sanitizer = true;
#else
inline constexpr bool with_sanitizer = false;
#endif

/// While this object exists, a system call or function fails in all processes that are started. `order` states which
/// one, see failing_calls.cpp.
class Failing {
 public:
  explicit Failing(const std::string& order) {
    setenv("ISOJAM_FAIL", order.c_str(), 1);
    setenv("LD_PRELOAD", ISOJAM_FAILING_CALLS, 1);
  }
  ~Failing() {
    unsetenv("LD_PRELOAD");
    unsetenv("ISOJAM_FAIL");
  }
  Failing(const Failing&) = delete;
  Failing& operator=(const Failing&) = delete;
};

/// The number of calls that a process counted. `err` is its output on stderr.
inline long calls_counted(const std::string& err, const std::string& call) {
  const std::string before = call + " calls: ";
  return std::atol(err.substr(err.find(before) + before.size()).c_str());
}

}  // namespace isojam::test
