#pragma once

#include <atomic>
#include <chrono>
#include <csignal>
#include <stop_token>
#include <thread>

namespace isojam {

/// While this object exists, SIGINT and SIGTERM cause a stop request instead of ending the process.
///
/// The process ends with exit code 75 if it still runs when the time `patience` has passed since the signal, or if a
/// second signal arrives. No recorded result is lost in this case, because files are written atomically.
///
/// Create the object before any other thread. It blocks both signals and waits for them in its own thread, because a
/// signal handler may not request a stop. Threads that are created later inherit the blocked signals.
///
/// A signal that was already ignored, for example under nohup or in the background of a shell, stays ignored.
class InterruptWatcher {
 public:
  explicit InterruptWatcher(std::chrono::milliseconds patience = std::chrono::milliseconds(1500));
  ~InterruptWatcher();
  InterruptWatcher(const InterruptWatcher&) = delete;
  InterruptWatcher& operator=(const InterruptWatcher&) = delete;

  std::stop_token token() const { return source_.get_token(); }

 private:
  void watch();

  const std::chrono::milliseconds patience_;
  sigset_t signals_{}, before_{};
  std::stop_source source_;
  std::atomic<bool> finished_{false};
  std::thread thread_;
};

}  // namespace isojam
