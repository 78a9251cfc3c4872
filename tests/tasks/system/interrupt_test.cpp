// Facts proved here, in processes made for the purpose: a process that listens to the stop request ends as it likes;
// one that does not listen is ended with exit code 75 within two seconds of the first signal, and at once by a second;
// without a signal, or with one that was ignored before, nothing happens.

#include "tasks/system/interrupt.hpp"

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
using Clock = std::chrono::steady_clock;

struct Ended {
  int exit_code = -1;
  double seconds_after_signal = 0;
};

/// Runs `work` under a watcher in a child that gets `signals` SIGTERMs; its exit code is what `work` returns.
Ended end_of(const std::function<int(const std::stop_token&)>& work, int signals) {
  int ready[2];
  EXPECT_EQ(pipe(ready), 0);
  const pid_t child = fork();
  if (child == 0) {
    const InterruptWatcher watcher;
    const char byte = 'r';
    if (write(ready[1], &byte, 1) != 1) _exit(9);
    _exit(work(watcher.token()));
  }
  char byte = 0;
  EXPECT_EQ(read(ready[0], &byte, 1), 1);
  const auto sent = Clock::now();
  for (int i = 0; i < signals; ++i) {
    if (i > 0) std::this_thread::sleep_for(100ms);
    kill(child, SIGTERM);
  }
  int status = 0;
  waitpid(child, &status, 0);
  close(ready[0]), close(ready[1]);
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, std::chrono::duration<double>(Clock::now() - sent).count()};
}

int deaf(const std::stop_token&) {
  std::this_thread::sleep_for(20s);
  return 3;
}

TEST(Interrupt, WhoListensEndsByItself) {
  const auto ended = end_of(
      [](const std::stop_token& stop) {
        while (!stop.stop_requested()) std::this_thread::sleep_for(1ms);
        return 5;
      },
      1);
  EXPECT_EQ(ended.exit_code, 5);
  EXPECT_LT(ended.seconds_after_signal, 1);
}

TEST(Interrupt, WhoDoesNotListenIsEnded) {
  const auto ended = end_of(deaf, 1);
  EXPECT_EQ(ended.exit_code, 75);
  EXPECT_GT(ended.seconds_after_signal, 1) << "no time to end by itself";
  EXPECT_LT(ended.seconds_after_signal, 2);
}

/// Waits for good in a message that nobody reads, and holds stderr meanwhile.
int choked(const std::stop_token&) {
  int unread[2];
  if (pipe(unread) != 0 || dup2(unread[1], STDERR_FILENO) < 0) return 9;
  const std::string words(1 << 20, 'x');
  std::fwrite(words.data(), 1, words.size(), stderr);
  return 3;
}

TEST(Interrupt, WhoWaitsForAReaderIsEnded) {
  const auto ended = end_of(choked, 1);
  EXPECT_EQ(ended.exit_code, 75);
  EXPECT_LT(ended.seconds_after_signal, 2);
}

TEST(Interrupt, ASecondSignalEndsAtOnce) {
  const auto ended = end_of(deaf, 2);
  EXPECT_EQ(ended.exit_code, 75);
  EXPECT_LT(ended.seconds_after_signal, 1);
}

TEST(Interrupt, ASignalThatIsIgnoredStaysSo) {
  const auto ignored = std::signal(SIGTERM, SIG_IGN);
  const auto ended = end_of(
      [](const std::stop_token& stop) {
        std::this_thread::sleep_for(300ms);
        return stop.stop_requested() ? 1 : 6;
      },
      2);
  std::signal(SIGTERM, ignored);
  EXPECT_EQ(ended.exit_code, 6);
}

TEST(Interrupt, WithoutASignalNothingHappens) {
  EXPECT_EQ(end_of([](const std::stop_token& stop) { return stop.stop_requested() ? 1 : 4; }, 0).exit_code, 4);
}

}  // namespace
}  // namespace isojam
