#pragma once

#include <gtest/gtest.h>

#include <chrono>
#include <csignal>
#include <map>
#include <memory>
#include <thread>

#include "tasks/records/store.hpp"
#include "tests/tasks/support/support.hpp"

namespace isojam::test {

using Files = std::map<std::string, std::string>;

inline Json crash_manifest() {
  auto manifest = tiny_manifest();
  manifest["sweep"]["particles"] = {24, 28, 40};
  manifest["measure"] = {"contacts"};
  manifest["keep_path"] = true;
  return manifest;
}

/// Base class of tests that interrupt runs. SetUpTestSuite() makes the results of an undisturbed run, with which the
/// tests compare theirs. Each test has its own directory.
class Crash : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    shared_ = std::make_unique<TemporaryDirectory>();
    write_text(*shared_ / "m.json", crash_manifest().dump());
    finished_ = isojam({"run", "m.json", "-o", "results"}, shared_->path());
  }
  static void TearDownTestSuite() { shared_.reset(); }

  void SetUp() override {
    ASSERT_EQ(finished_.exit_code, 0) << finished_.err;
    write_text(here_ / "m.json", crash_manifest().dump());
  }

  Finished run(const std::function<void(int)>& meanwhile = {}, const std::string& results = "results") const {
    return isojam({"run", "m.json", "-o", results}, here_.path(), meanwhile);
  }
  static Files reference() { return results_below(*shared_ / "results"); }
  Files results() const { return results_below(here_ / "results"); }
  void copy_reference() const {
    std::filesystem::copy(*shared_ / "results", here_ / "results", std::filesystem::copy_options::recursive);
  }

  // NOLINTBEGIN(cppcoreguidelines-avoid-non-const-global-variables): GoogleTest's way to share a costly set-up.
  static inline std::unique_ptr<TemporaryDirectory> shared_;
  static inline Finished finished_;
  // NOLINTEND(cppcoreguidelines-avoid-non-const-global-variables)
  TemporaryDirectory here_;
};

/// Waits until a run has written `count` checkpoints, and then sends the signal to the process.
inline void stop_at_checkpoints(const std::filesystem::path& results, std::size_t count, int process, int signal) {
  for (int i = 0; i < 200000; ++i) {
    if (names_in(results / "checkpoints").size() >= count) break;
    std::this_thread::sleep_for(std::chrono::microseconds(500));
  }
  if (process > 0) kill(process, signal);
}

}  // namespace isojam::test
