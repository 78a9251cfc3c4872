// A preloaded library lets system calls fail (tests/tasks/support/failing_calls.cpp).

#include <gtest/gtest.h>

#include <algorithm>
#include <cerrno>

#include "tasks/io/sealed.hpp"
#include "tasks/records/recorded.hpp"
#include "tests/tasks/run/failing.hpp"
#include "tests/tasks/support/support.hpp"

namespace isojam {
namespace {

namespace fs = std::filesystem;
using test::Failing;
using test::isojam;

class ResourceFailure : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    shared_ = std::make_unique<test::TemporaryDirectory>();
    auto manifest = test::tiny_manifest();
    manifest["measure"] = {"contacts"};
    test::write_text(*shared_ / "m.json", manifest.dump());
    finished_ = isojam({"run", "m.json", "-o", "results"}, shared_->path());
  }
  static void TearDownTestSuite() { shared_.reset(); }

  void SetUp() override {
    if (test::with_sanitizer) GTEST_SKIP() << "a sanitizer has the library's calls for itself";
    ASSERT_EQ(finished_.exit_code, 0) << finished_.err;
    fs::copy_file(*shared_ / "m.json", here_ / "m.json");
  }
  test::Finished run() const { return isojam({"run", "m.json", "-o", "results"}, here_.path()); }
  void begin_with_reference() const {
    fs::remove_all(here_ / "results");
    fs::copy(*shared_ / "results", here_ / "results", fs::copy_options::recursive);
  }
  long count_of(const std::string& call) const {
    const Failing count(call + " count");
    return test::calls_counted(run().err, call);
  }
  /// Calls `work` for about so many of the calls, including the first and the last.
  template <class Work>
  static int some_of(long first, long last, long trials, const Work& work) {
    int tried = 0;
    const auto step = std::max(1L, (last - first) / trials);
    for (long k = first; k <= last; k += step, ++tried) work(k);
    return tried;
  }
  static void expect_ended_well(const test::Finished& ended, const std::string& order) {
    EXPECT_TRUE(ended.exit_code == 0 || ended.exit_code == 1) << order << ": " << ended.exit_code << ' ' << ended.err;
    if (ended.exit_code == 1) {
      EXPECT_NE(ended.err.find("error: "), std::string::npos) << order << ": " << ended.err;
    }
  }

  // NOLINTBEGIN(cppcoreguidelines-avoid-non-const-global-variables): GoogleTest's way to share a costly set-up.
  static inline std::unique_ptr<test::TemporaryDirectory> shared_;
  static inline test::Finished finished_;
  // NOLINTEND(cppcoreguidelines-avoid-non-const-global-variables)
  test::TemporaryDirectory here_;
};

struct Refusal {
  std::string call;
  int error;
};
const std::vector<Refusal>& refusals() {
  static const std::vector<Refusal> all{{"malloc", ENOMEM}, {"open", EMFILE},   {"read", EIO},   {"write", ENOSPC},
                                        {"fsync", EIO},     {"rename", ENOSPC}, {"link", EPERM}, {"thread", EAGAIN}};
  return all;
}

TEST_F(ResourceFailure, ACompleteDirectoryDoesNotChange) {
  begin_with_reference();
  const auto before = test::files_below(here_ / "results");
  for (const auto& [call, error] : refusals()) {
    int ended_early = 0;
    const auto calls = count_of(call);
    const auto tried = some_of(1, calls, calls > 100 ? 25 : 10, [&, &name = call, &code = error](long k) {
      const auto order = name + ' ' + std::to_string(k) + ' ' + std::to_string(code);
      const Failing failing(order);
      const auto ended = run();
      expect_ended_well(ended, order);
      ended_early += ended.exit_code != 0;
      EXPECT_EQ(test::files_below(here_ / "results"), before) << order;
    });
    std::printf("%s: %d of %ld calls failed, %d runs ended by it\n", call.c_str(), tried, calls, ended_early);
  }
}

TEST_F(ResourceFailure, NoOutcomeIsRecorded) {
  const auto reference = test::results_below(*shared_ / "results");
  for (const auto& [call, error] : refusals()) {
    fs::remove_all(here_ / "results");
    const auto calls = count_of(call);
    // The first few hundred allocations are made before the program can print a message.
    some_of(call == "malloc" ? 1000 : 1, calls, call == "malloc" ? 4 : 1, [&, &name = call, &code = error](long k) {
      fs::remove_all(here_ / "results");
      const auto order = name + ' ' + std::to_string(k) + "+ " + std::to_string(code);
      {
        const Failing failing(order);
        expect_ended_well(run(), order);
      }
      for (const auto& replicate : names_in(here_ / "results" / "records")) {
        const auto record = read_sealed((here_ / "results/records" / (replicate + ".json")).string());
        EXPECT_EQ(record.at("status"), "done") << order << ": " << record.dump(2).substr(0, 1000);
      }
      EXPECT_EQ(run().exit_code, 0);
      EXPECT_EQ(test::results_below(here_ / "results"), reference) << order;
    });
  }
}

TEST_F(ResourceFailure, ARerunThatCannotBeWrittenKeepsTheRecord) {
  begin_with_reference();
  const auto before = test::files_below(here_ / "results");
  const auto name = names_in(here_ / "results" / "records").front();
  for (const std::string order : {"write 1+ 28", "open 10+ 24", "rename 1+ 5", "thread 1+ 11", "malloc 30000+ 12"}) {
    const Failing failing(order);
    const auto ended = isojam({"rerun", "results", name}, here_.path());
    EXPECT_EQ(ended.exit_code, 1) << order << ": " << ended.err;
    EXPECT_NE(ended.err.find("error: "), std::string::npos) << order << ": " << ended.err;
    EXPECT_EQ(test::files_below(here_ / "results"), before) << order;
  }
}

TEST_F(ResourceFailure, EveryResultAndItsFolderAreSynchronised) {
  const auto files = static_cast<long>(test::results_below(*shared_ / "results").size());
  const long all = count_of("fsync");
  fs::remove_all(here_ / "results");
  const long folders = count_of("syncdir");
  EXPECT_GE(folders, files);
  EXPECT_GE(all - folders, files);
}

TEST_F(ResourceFailure, ASmallStackIsSufficient) {
  auto manifest = test::tiny_manifest();
  manifest["measure"] = {"contacts", "modes"};
  manifest["replicates"] = 1;
  manifest["sweep"]["particles"] = {24};
  test::write_text(here_ / "m.json", manifest.dump());
  const auto usual = test::shell("$ISOJAM run m.json -o usual -j 1", here_.path());
  EXPECT_EQ(usual.exit_code, 0) << usual.err;
  const auto little = test::shell("ulimit -s 64; $ISOJAM run m.json -o little -j 1", here_.path());
  EXPECT_EQ(little.exit_code, 0) << little.err;
  EXPECT_EQ(test::results_below(here_ / "little"), test::results_below(here_ / "usual"));
}

TEST_F(ResourceFailure, FileSystemsWithFewFunctionsAreSufficient) {
  const auto reference = test::results_below(*shared_ / "results");
  for (const std::string order : {"syncdir 1+ 22", "syncdir 1+ 95", "link 1+ 95;renameat2 1+ 22", "link 1+ 1"}) {
    fs::remove_all(here_ / "results");
    const Failing failing(order);
    const auto ended = run();
    EXPECT_EQ(ended.exit_code, 0) << order << ": " << ended.err;
    EXPECT_EQ(test::results_below(here_ / "results"), reference) << order;
  }
}

TEST_F(ResourceFailure, AnUnreadableManifestIsNotReportedAsInvalid) {
  for (const std::string command : {"run", "validate"}) {
    const Failing failing("read 1+ 5");
    const auto ended = isojam({command, "m.json"}, here_.path());
    EXPECT_EQ(ended.exit_code, 1) << ended.err;
    EXPECT_NE(ended.err.find("m.json: cannot be read: Input/output error"), std::string::npos) << ended.err;
  }
}

TEST_F(ResourceFailure, WithLittleMemoryFromTheStart) {
  begin_with_reference();
  const auto before = test::files_below(here_ / "results");
  int short_of = 0;
  for (const long megabytes : {20, 22, 24, 26, 28, 30, 34, 40}) {
    const auto limit = std::to_string(megabytes << 10);
    const auto ended = test::shell("ulimit -v " + limit + "; $ISOJAM run m.json -o results", here_.path());
    // With less memory than the libraries need, the loader ends the program.
    EXPECT_TRUE(ended.exit_code == 0 || ended.exit_code == 1 || ended.exit_code == 127)
        << megabytes << " MiB: " << ended.exit_code << ' ' << ended.err;
    short_of += ended.exit_code == 1;
    EXPECT_EQ(test::files_below(here_ / "results"), before) << megabytes << " MiB";
  }
  EXPECT_GT(short_of, 0) << "every run had enough";
}

}  // namespace
}  // namespace isojam
