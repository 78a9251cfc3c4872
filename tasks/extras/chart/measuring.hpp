#pragma once

#include <chrono>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <stop_token>
#include <string>
#include <thread>
#include <vector>

#include "tasks/extras/chart/config.hpp"
#include "tasks/extras/chart/point.hpp"
#include "tasks/io/thread_clock.hpp"

namespace isojam {

/// Requests a stop after a given time, or when the stop token `outer` requests a stop.
class Deadline {
 public:
  Deadline(double seconds, const std::stop_token& outer)
      : on_outer_(outer, [this] { source_.request_stop(); }), timer_([this, seconds](const std::stop_token& end) {
          std::mutex mutex;
          std::condition_variable_any wake;
          std::unique_lock lock(mutex);
          wake.wait_for(lock, end, std::chrono::duration<double>(seconds), [] { return false; });
          if (!end.stop_requested()) source_.request_stop();
        }) {}
  std::stop_token token() const { return source_.get_token(); }

 private:
  std::stop_source source_;
  std::stop_callback<std::function<void()>> on_outer_;
  std::jthread timer_;  // declared last, so that its thread ends before the members that it uses are destroyed
};

/// Settings of all measurements of a chart.
struct Measuring {
  const ChartConfig& config;
  std::stop_token stop;  ///< requests a stop when the time limit is reached, or after a signal
  /// called before each part is measured, with the name of the part
  std::function<void(const std::string& next)> progress;

  bool over() const { return stop.stop_requested(); }
};

/// Work that takes longer than this is timed only once. Repetitions only reduce the noise of the clock, which is small
/// for such work.
inline constexpr double seconds_worth_repeating = 0.1;

/// Runs `work` as often as the configuration requires, and returns the CPU time of the calling thread for each run.
/// Stops earlier if all runs together take longer than seconds_worth_repeating. `work` must give the same result each
/// time.
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
