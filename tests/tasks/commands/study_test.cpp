// A complete study of a new user at a terminal. Properties tested here:
// - With a stopping rule, replicates run until the confidence interval of φ_J is narrow enough. The progress bar of
//   each round never counts beyond its end.
// - With twice as many replicates, existing records do not change, byte for byte.
// - If a parameter is changed, `run` and its dry run report the key that differs, and change nothing.
// - An interrupted run reports this, and `status` shows that no process works on it. The same command then gives the
//   same bytes as an uninterrupted run.
// - Table, report and export work with the result.

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <regex>
#include <thread>

#include "tasks/io/parse.hpp"
#include "tasks/records/recorded.hpp"
#include "tests/tasks/support/support.hpp"

namespace isojam {
namespace {

namespace fs = std::filesystem;
using test::isojam;

Json study(int most) {
  auto manifest = test::tiny_manifest();
  manifest["name"] = "study";
  manifest["seed"] = 8;
  manifest["sweep"]["particles"] = {24};
  manifest["measure"] = {"contacts"};
  // A width that so few replicates cannot reach, so that every round is needed.
  manifest["replicates"] = {{"min", 4}, {"max", most}, {"quantity", "phi_j"}, {"half_width", 1e-4}};
  return manifest;
}

/// Output and exit code of a command that is typed into a terminal in `directory`.
std::pair<std::string, int> typed(const std::vector<std::string>& arguments, const fs::path& directory) {
  return test::on_a_terminal([&] {
    std::vector<std::string> words{ISOJAM_EXECUTABLE};
    words.insert(words.end(), arguments.begin(), arguments.end());
    std::vector<char*> argv;
    for (auto& word : words) argv.push_back(word.data());
    argv.push_back(nullptr);
    if (chdir(directory.c_str()) == 0) execv(argv[0], argv.data());
    _exit(127);
  });
}

/// Checks that every "k of n replicates" has a bar of the same length and k ≤ n.
void expect_bars(const std::string& text, int least) {
  const std::regex bar(R"(\[([#.]*)\] (\d+) of (\d+) replicates?)");
  int bars = 0;
  for (std::sregex_iterator found(text.begin(), text.end(), bar), end; found != end; ++found, ++bars) {
    EXPECT_EQ((*found)[1].length(), 24) << found->str();
    EXPECT_LE(std::stoi((*found)[2]), std::stoi((*found)[3])) << found->str();
  }
  EXPECT_GE(bars, least) << text;
}

TEST(Study, OfANewUser) {
  const test::TemporaryDirectory here;
  const auto results = here / "results/study";
  const auto write = [&](const Json& manifest) { test::write_text(here / "m.json", manifest.dump(2)); };
  const auto records = [&] { return names_in(results / "records").size(); };

  write(study(8));
  const auto [first, first_status] = typed({"run", "m.json"}, here.path());
  ASSERT_TRUE(WIFEXITED(first_status) && WEXITSTATUS(first_status) == 0) << first;
  EXPECT_NE(first.find("confidence interval still too wide: running 2 more replicates"), std::string::npos) << first;
  EXPECT_NE(first.find("phi_j"), std::string::npos) << first;
  expect_bars(first, 2);
  EXPECT_EQ(records(), 8U);

  const auto eight = test::files_below(results / "records");
  write(study(16));
  const auto [second, second_status] = typed({"run", "m.json"}, here.path());
  ASSERT_TRUE(WIFEXITED(second_status) && WEXITSTATUS(second_status) == 0) << second;
  EXPECT_EQ(records(), 16U);
  const auto sixteen = test::files_below(results / "records");
  for (const auto& [name, content] : eight) EXPECT_EQ(sixteen.at(name), content) << name;

  const auto before = test::files_below(results);
  auto changed = study(16);
  changed["protocol"]["step_fraction"] = 0.3;
  write(changed);
  for (const std::vector<std::string>& command :
       {std::vector<std::string>{"run", "m.json"}, {"run", "m.json", "--dry-run"}}) {
    const auto refused = isojam(command, here.path());
    EXPECT_EQ(refused.exit_code, 65) << refused.err;
    EXPECT_NE(refused.err.find("/protocol/step_fraction: 0.4 in the directory, 0.3 in this manifest"),
              std::string::npos)
        << refused.err;
    EXPECT_EQ(test::files_below(results), before);
  }

  write(study(16));
  const auto stopped = isojam({"run", "m.json", "-o", "again"}, here.path(), [&](int process) {
    for (int k = 0; k < 200000 && names_in(here / "again/records").size() < 5; ++k)
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    kill(process, SIGINT);
  });
  EXPECT_EQ(stopped.exit_code, 75) << stopped.err;
  EXPECT_NE(stopped.err.find("repeat the command to resume"), std::string::npos) << stopped.err;
  const auto status = isojam({"status", "again"}, here.path());
  EXPECT_NE(status.out.find(" 0 running"), std::string::npos) << status.out;
  EXPECT_NE(status.out.find("no process works in this directory"), std::string::npos) << status.out;
  EXPECT_EQ(isojam({"run", "m.json", "-o", "again"}, here.path()).exit_code, 0);
  EXPECT_EQ(test::results_below(here / "again"), test::results_below(results));

  EXPECT_EQ(isojam({"aggregate", "results/study"}, here.path()).out, isojam({"aggregate", "again"}, here.path()).out);
  EXPECT_EQ(isojam({"report", "results/study"}, here.path()).exit_code, 0);
  const auto exported = isojam({"export", "again", "all", "--format", "xyz", "-o", "xyz"}, here.path());
  EXPECT_EQ(exported.exit_code, 0) << exported.err;
  EXPECT_EQ(test::files_below(here / "xyz").size(), 32U) << exported.out;
}

}  // namespace
}  // namespace isojam
