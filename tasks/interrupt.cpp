#include "tasks/interrupt.hpp"

#include <cstdlib>

#include "tasks/exit_codes.hpp"

namespace isojam {

InterruptWatcher::InterruptWatcher() {
  sigemptyset(&signals_);
  sigaddset(&signals_, SIGINT);
  sigaddset(&signals_, SIGTERM);
  pthread_sigmask(SIG_BLOCK, &signals_, &before_);
  thread_ = std::thread([this] { watch(); });
}

InterruptWatcher::~InterruptWatcher() {
  finished_ = true;
  // Wakes sigwait in that thread and ends nothing: the signal is blocked.
  pthread_kill(thread_.native_handle(), SIGTERM);  // NOLINT(bugprone-bad-signal-to-kill-thread)
  thread_.join();
  pthread_sigmask(SIG_SETMASK, &before_, nullptr);
}

void InterruptWatcher::watch() {
  for (int signal = 0; sigwait(&signals_, &signal) == 0;) {
    if (finished_) return;
    if (source_.stop_requested()) std::_Exit(static_cast<int>(ExitCode::interrupted));
    source_.request_stop();
  }
}

}  // namespace isojam
