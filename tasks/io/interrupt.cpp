#include "tasks/io/interrupt.hpp"

#include <fmt/format.h>
#include <poll.h>
#include <unistd.h>

#include <cstdlib>
#include <string_view>

#include "tasks/io/exit_codes.hpp"
#include "tasks/io/texts.hpp"

namespace isojam {
namespace {

/// Signal that wakes the watcher thread when the program ends. Nobody else sends SIGURG to request something.
constexpr int wake = SIGURG;

/// Writes to stderr without blocking. A full pipe that nobody reads must not stop this thread.
void say(std::string_view text) {
  pollfd err{STDERR_FILENO, POLLOUT, 0};
  if (poll(&err, 1, 0) == 1 && (err.revents & POLLOUT) != 0) [[maybe_unused]]
    const auto written = write(STDERR_FILENO, text.data(), text.size());
}

bool is_ignored(int signal) {
  struct sigaction action {};
  return sigaction(signal, nullptr, &action) == 0 && action.sa_handler == SIG_IGN;
}

/// Waits for one of the signals at most this long. Returns whether one arrived. (macOS has no sigtimedwait.)
bool arrives(const sigset_t& signals, std::chrono::milliseconds patience) {
  constexpr std::chrono::milliseconds pause{10};
  for (;; patience -= pause) {
    sigset_t pending{};
    sigpending(&pending);
    for (const int signal : {SIGINT, SIGTERM, wake}) {
      int found = 0;
      if (sigismember(&signals, signal) == 1 && sigismember(&pending, signal) == 1)
        return sigwait(&signals, &found) == 0;
    }
    if (patience <= pause) return false;
    std::this_thread::sleep_for(pause);
  }
}

}  // namespace

InterruptWatcher::InterruptWatcher(std::chrono::milliseconds patience) : patience_(patience) {
  sigemptyset(&signals_);
  // sigwait would also receive blocked signals that are ignored, so ignored signals are left out.
  for (const int signal : {SIGINT, SIGTERM}) {
    if (!is_ignored(signal)) sigaddset(&signals_, signal);
  }
  sigaddset(&signals_, wake);
  pthread_sigmask(SIG_BLOCK, &signals_, &before_);
  thread_ = std::thread([this] { watch(); });
}

InterruptWatcher::~InterruptWatcher() {
  finished_ = true;
  pthread_kill(thread_.native_handle(), wake);
  thread_.join();
  // A signal that is still pending arrived too late to stop anything. It must not kill a process that has finished.
  while (arrives(signals_, std::chrono::milliseconds(0))) {
  }
  pthread_sigmask(SIG_SETMASK, &before_, nullptr);
}

void InterruptWatcher::watch() {
  for (int signal = wake; signal == wake;) {
    if (sigwait(&signals_, &signal) != 0 || finished_) return;
  }
  source_.request_stop();
  // If the program does not stop within `patience_`, end it. Some measures of large packings do not check for requests;
  // their results are discarded.
  if (arrives(signals_, patience_) && finished_) return;
  say(fmt::format("\nisojam: warning: {}\n", interrupted_run));
  std::_Exit(static_cast<int>(ExitCode::interrupted));
}

}  // namespace isojam
