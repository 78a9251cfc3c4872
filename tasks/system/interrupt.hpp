#pragma once

#include <atomic>
#include <chrono>
#include <csignal>
#include <stop_token>
#include <thread>

namespace isojam {

/// Turns SIGINT and SIGTERM into a stop request while it lives. If the process goes on for longer than `patience`, or a
/// second signal comes, it ends at once with exit code 75; files are written atomically, so nothing is lost by it. To
/// be made before any other thread, which inherits the blocked signals: a handler could not request a stop, since that
/// is not safe within one. A signal that is ignored already, as under nohup or in the background of a shell, stays so.
class InterruptWatcher {
 public:
  explicit InterruptWatcher(std::chrono::milliseconds patience = std::chrono::milliseconds(1500));
  ~InterruptWatcher();
  InterruptWatcher(const InterruptWatcher&) = delete;
  InterruptWatcher& operator=(const InterruptWatcher&) = delete;

  std::stop_token token() const { return source_.get_token(); }

 private:
  void watch();

  const timespec patience_;
  sigset_t signals_{}, before_{};
  std::stop_source source_;
  std::atomic<bool> finished_{false};
  std::thread thread_;
};

}  // namespace isojam
