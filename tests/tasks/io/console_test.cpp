#include "tasks/io/console.hpp"

#include <gtest/gtest.h>
#include <sys/wait.h>

#include <regex>
#include <string>
#include <thread>

#include "tests/tasks/support/support.hpp"

namespace isojam {
namespace {

/// Rounds of 6, 2 and 3 replicates.
void rounds() {
  Console console({});
  for (const int total : {6, 2, 3}) {
    console.begin(total, total);
    for (int k = 0; k < total; ++k) {
      console.finished(1, false);
      std::this_thread::sleep_for(std::chrono::milliseconds(110));
      console.tick("a step");
    }
    console.end();
  }
}

TEST(Console, CountsEveryRoundFromZeroOnATerminal) {
  const auto [text, status] = test::on_a_terminal(rounds);
  ASSERT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0) << "status " << status << " after: " << text;
  std::vector<std::string> counts;
  const std::regex bar(R"(\[([#.]*)\] (\d+ of \d+) replicates)");
  for (std::sregex_iterator found(text.begin(), text.end(), bar), end; found != end; ++found) {
    EXPECT_EQ((*found)[1].length(), 24) << found->str();
    counts.push_back((*found)[2]);
  }
  const std::vector<std::string> expected{"1 of 6", "2 of 6", "3 of 6", "4 of 6", "5 of 6", "6 of 6",
                                          "1 of 2", "2 of 2", "1 of 3", "2 of 3", "3 of 3"};
  EXPECT_EQ(counts, expected) << text;
  EXPECT_TRUE(std::regex_search(text, std::regex("1 of 2 replicates, [^\r]+ left"))) << text;
  EXPECT_TRUE(text.ends_with("\r\033[K")) << text;
}

TEST(Console, NothingIsWiderThanTheTerminal) {
  for (const int columns : {20, 35, 60, 200}) {
    const auto [text, status] = test::on_a_terminal(rounds, columns);
    ASSERT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0) << text;
    int bars = 0, shown = 0;
    const std::string clear = "\r\033[K";
    for (auto at = text.find(clear); at != std::string::npos; ++shown) {
      const auto next = text.find(clear, at + clear.size());
      const auto line = text.substr(at + clear.size(), next == std::string::npos ? next : next - at - clear.size());
      EXPECT_LT(line.size(), static_cast<std::size_t>(columns)) << line;
      bars += line.starts_with('[');
      at = next;
    }
    EXPECT_GT(shown, 11) << columns;
    EXPECT_EQ(bars > 0, columns >= 60) << text;
  }
}

}  // namespace
}  // namespace isojam
