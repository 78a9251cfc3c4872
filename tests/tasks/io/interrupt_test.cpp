// Signals are sent to child processes.

#include "tasks/io/interrupt.hpp"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdio>
#include <functional>
#include <string>
#include <thread>

namespace isojam {
namespace {

using namespace std::chrono_literals;

// No test waits for `forever`, and no result depends on how long `short_while` takes.
constexpr std::chrono::milliseconds forever = 1h, short_while = 200ms;

/// A pipe from the child to its parent.
struct Pipe {
  Pipe() { EXPECT_EQ(pipe(ends), 0); }
  ~Pipe() { close(ends[0]), close(ends[1]); }
  Pipe(const Pipe&) = delete;
  Pipe& operator=(const Pipe&) = delete;

  void tell() const {
    const char byte = 'r';
    if (write(ends[1], &byte, 1) != 1) _exit(9);
  }
  void await() const {
    char byte = 0;
    EXPECT_EQ(read(ends[0], &byte, 1), 1);
  }
  int ends[2];
};

/// Exit code of a child that does `work` under a watcher and gets `signals` SIGTERMs: the first when the watcher is
/// ready, the second after the stop request.
int exit_code_of(const std::function<int(const std::stop_token&)>& work, int signals,
                 std::chrono::milliseconds patience = forever) {
  const Pipe ready, asked;
  const pid_t child = fork();
  if (child == 0) {
    const InterruptWatcher watcher(patience);
    const std::stop_callback tell(watcher.token(), [&asked] { asked.tell(); });
    ready.tell();
    _exit(work(watcher.token()));
  }
  ready.await();
  for (int k = 0; k < signals; ++k) {
    if (k > 0) asked.await();
    kill(child, SIGTERM);
  }
  int status = 0;
  waitpid(child, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

int deaf(const std::stop_token&) {
  std::this_thread::sleep_for(60s);
  return 3;
}

TEST(Interrupt, AProcessThatDoesNotReactIsEnded) { EXPECT_EQ(exit_code_of(deaf, 1, short_while), 75); }

/// Waits forever to write a message that nobody reads, and holds stderr in the meantime.
int choked(const std::stop_token&) {
  int unread[2];
  if (pipe(unread) != 0 || dup2(unread[1], STDERR_FILENO) < 0) return 9;
  const std::string words(1 << 20, 'x');
  std::fwrite(words.data(), 1, words.size(), stderr);
  return 3;
}

TEST(Interrupt, AProcessThatWaitsForAReaderIsEnded) { EXPECT_EQ(exit_code_of(choked, 1, short_while), 75); }

TEST(Interrupt, ASecondSignalEndsItAtOnce) { EXPECT_EQ(exit_code_of(deaf, 2), 75); }

TEST(Interrupt, AnIgnoredSignalStaysIgnored) {
  const auto ignored = std::signal(SIGTERM, SIG_IGN);
  const auto ended = exit_code_of(
      [](const std::stop_token& stop) {
        std::this_thread::sleep_for(short_while);
        return stop.stop_requested() ? 1 : 6;
      },
      1);
  std::signal(SIGTERM, ignored);
  EXPECT_EQ(ended, 6);
}

}  // namespace
}  // namespace isojam
