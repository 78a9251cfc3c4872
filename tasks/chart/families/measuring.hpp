#pragma once

#include <chrono>
#include <functional>
#include <stop_token>
#include <string>
#include <vector>

#include "tasks/chart/config/config.hpp"
#include "tasks/chart/config/deadline.hpp"
#include "tasks/chart/results/point.hpp"
#include "tasks/system/thread_clock.hpp"

namespace isojam {

/// Shared by all measurements of a chart.
struct Measuring {
  const ChartConfig& config;
  std::stop_token stop;                                   ///< time over, or a signal
  std::function<void(const std::string& next)> progress;  ///< called before each part of a measurement

  bool over() const { return stop.stop_requested(); }
};

/// Longer work is timed once, because repetitions only reduce the noise of the clock.
inline constexpr double seconds_worth_repeating = 0.1;

/// Runs `work` as often as the configuration requires, fewer times if it takes long, and returns the CPU times of the
/// calling thread. `work` must give the same result each time.
template <class Work>
std::vector<double> timed(const Measuring& measuring, const Work& work) {
  const auto begun = std::chrono::steady_clock::now();
  std::vector<double> seconds;
  while (static_cast<int>(seconds.size()) < measuring.config.repetitions) {
    const double before = thread_cpu_seconds();
    work();
    seconds.push_back(thread_cpu_seconds() - before);
    const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - begun;
    if (measuring.over() || spent.count() > seconds_worth_repeating) break;
  }
  return seconds;
}

}  // namespace isojam
