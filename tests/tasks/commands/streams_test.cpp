#include <gtest/gtest.h>

#include "tests/tasks/support/support.hpp"

namespace isojam {
namespace {

namespace fs = std::filesystem;
using test::shell;

class Streams : public testing::Test {
 protected:
  void SetUp() override {
    auto manifest = test::tiny_manifest();
    manifest["measure"] = {"contacts"};
    manifest["sweep"]["particles"] = {24};
    manifest["keep_path"] = true;
    test::write_text(here_ / "m.json", manifest.dump());
  }
  test::TemporaryDirectory here_;
};

TEST_F(Streams, LostOutputIsReported) {
  ASSERT_EQ(shell("$ISOJAM run m.json -o r", here_.path()).exit_code, 0);
  for (const std::string command :
       {"run m.json -o r", "run m.json -o r --dry-run", "validate m.json", "status r", "aggregate r",
        "aggregate r --format json", "rerun r dodecahedron-N24-r0000", "report r",
        "export r all --format xyz -o exported", "--help", "run --help", "--version"}) {
    for (const std::string stream : {">/dev/full", ">&-"}) {
      const auto ended = shell("$ISOJAM " + command + ' ' + stream, here_.path());
      EXPECT_EQ(ended.exit_code, 1) << command << ' ' << stream << ": " << ended.err;
      const std::string message = "standard output: cannot be written: ";
      const auto said = ended.err.find(message);
      EXPECT_NE(said, std::string::npos) << command << ' ' << stream << ": " << ended.err;
      EXPECT_EQ(ended.err.find(message, said + 1), std::string::npos) << "twice: " << ended.err;
    }
  }
}

TEST_F(Streams, MessagesStayOutOfResults) {
  ASSERT_EQ(shell("$ISOJAM run m.json -o r", here_.path()).exit_code, 0);
  for (const std::string closed : {"2>&-", "<&- 2>&-", "<&- >&- 2>&-"}) {
    fs::remove_all(here_ / "closed");
    // With -v there are more messages.
    const auto ended = shell("$ISOJAM run -v m.json -o closed " + closed, here_.path());
    EXPECT_EQ(ended.exit_code, closed.find(" >") == std::string::npos ? 0 : 1) << closed;
    EXPECT_EQ(test::results_below(here_ / "closed"), test::results_below(here_ / "r")) << closed;
  }
}

TEST_F(Streams, InvalidNumbersAreRejected) {
  for (const std::string word : {"nan", "inf", "-1", "0", "1e400", "x"}) {
    const auto ended = shell("$ISOJAM run m.json -o r --memory=" + word, here_.path());
    EXPECT_EQ(ended.exit_code, 2) << word << ": " << ended.err;
    EXPECT_FALSE(fs::exists(here_ / "r")) << word;
  }
}

TEST_F(Streams, OutputsFollowLinksAndStreams) {
  ASSERT_EQ(shell("$ISOJAM run m.json -o r", here_.path()).exit_code, 0);
  // A stream receives only one file: the shape of the solid of an XYZ file is omitted, and a collection of files is
  // rejected.
  const auto name = "dodecahedron-N24-r0000";
  for (const std::string stream : {"fifo", "descriptor"}) {
    fs::remove_all(here_ / "beside");
    fs::create_directory(here_ / "beside");
    const std::string target = stream == "fifo" ? "beside/pipe" : "/dev/fd/7";
    const auto line = [&](const std::string& options) {
      return std::string("rm -f beside/pipe; mkfifo beside/pipe; (cat beside/pipe >/dev/null) 2>/dev/null & cat=$!; ") +
             "$ISOJAM export r " + name + options + " -o " + target +
             " 7>seven; code=$?; kill $cat 2>/dev/null; exit $code";
    };
    EXPECT_EQ(shell(line(" --format xyz"), here_.path()).exit_code, 0) << stream;
    EXPECT_EQ(shell(line(" --format vtp --path"), here_.path()).exit_code, 2) << stream;
    EXPECT_EQ(std::distance(fs::directory_iterator(here_ / "beside"), {}), 1) << stream;
    EXPECT_FALSE(fs::exists("/dev/fd/7.obj") || fs::exists(here_ / "beside/pipe.obj")) << stream;
  }
  // A descriptor that a shell opened counts as a stream, even if it belongs to a file.
  const auto opened = shell(
      "$ISOJAM aggregate r -o /dev/stdout | head -c 2000 >piped && "
      "$ISOJAM aggregate r --format csv -o /dev/stdout >both && $ISOJAM aggregate r --format csv >csv && "
      "cat r/tables.json csv | cmp - both && $ISOJAM aggregate r -o /dev/fd/7 7>seven >table && "
      "cmp seven r/tables.json && $ISOJAM aggregate r --format json >json && cmp json seven",
      here_.path());
  EXPECT_EQ(opened.exit_code, 0) << opened.out << opened.err;
  const auto ended = shell(
      "mkfifo pipe; (cat pipe >copy) & $ISOJAM aggregate r -o pipe && wait && "
      "$ISOJAM aggregate r -o /dev/null && ln -s target link && : >target && chmod 600 target && "
      "$ISOJAM aggregate r -o link && cmp copy target && cmp copy r/tables.json && test -h link && test -p pipe && "
      "test -c /dev/null && stat -c %a target",
      here_.path());
  EXPECT_EQ(ended.exit_code, 0) << ended.err;
  EXPECT_TRUE(ended.out.ends_with("600\n")) << ended.out;
}

}  // namespace
}  // namespace isojam
