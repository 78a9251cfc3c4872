#include "tasks/extras/chart/deadline.hpp"

#include <condition_variable>
#include <mutex>

namespace isojam {

Deadline::Deadline(double seconds, const std::stop_token& outer)
    : on_outer_(outer, [this] { source_.request_stop(); }), timer_([this, seconds](const std::stop_token& end) {
        std::mutex mutex;
        std::condition_variable_any wake;
        std::unique_lock lock(mutex);
        wake.wait_for(lock, end, std::chrono::duration<double>(seconds), [] { return false; });
        if (!end.stop_requested()) source_.request_stop();
      }) {}

}  // namespace isojam
