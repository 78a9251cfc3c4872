#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <sstream>
#include <utility>

#include "tests/tasks/support/bad_manifests.hpp"
#include "tests/tasks/support/support.hpp"

namespace isojam {
namespace {

using test::files_below;
using test::isojam;
using test::TemporaryDirectory;

long lines_of(const std::string& text) { return std::count(text.begin(), text.end(), '\n'); }

TEST(Program, RejectsInvalidManifestsAndWritesNothing) {
  const TemporaryDirectory directory;
  const auto manifest = directory / "m.json";
  for (const auto& bad : test::bad_manifests()) {
    test::write_text(manifest, bad.text);
    const auto before = files_below(directory.path());
    const auto run = isojam({"run", "m.json", "-o", "results"}, directory.path());
    EXPECT_EQ(run.exit_code, 65) << bad.name;
    EXPECT_EQ(run.out, "") << bad.name;
    EXPECT_EQ(lines_of(run.err), 1) << bad.name << ": " << run.err;
    EXPECT_EQ(run.err.rfind("isojam: error: m.json", 0), 0U) << bad.name << ": " << run.err;
    EXPECT_NE(run.err.find(bad.pointer), std::string::npos) << bad.name << ": " << run.err;
    EXPECT_NE(run.err.find(bad.says), std::string::npos) << bad.name << ": " << run.err;
    EXPECT_EQ(files_below(directory.path()), before) << bad.name;
    EXPECT_FALSE(std::filesystem::exists(directory / "results")) << bad.name;
    const auto validate = isojam({"validate", "m.json"}, directory.path());
    EXPECT_EQ(validate.exit_code, 65) << bad.name;
    EXPECT_EQ(validate.err, run.err) << bad.name;
  }
}

TEST(Program, ValidatesAGoodManifest) {
  const TemporaryDirectory directory;
  auto manifest = test::good_manifest();
  manifest["sweep"]["target_energy"] = {1e-6, 1e-5, 1e-4};
  for (const std::string mark : {"", "\xEF\xBB\xBF"}) {
    test::write_text(directory / "m.json", mark + manifest.dump());
    const auto validate = isojam({"validate", "m.json"}, directory.path());
    EXPECT_EQ(validate.exit_code, 0) << validate.err;
    EXPECT_EQ(validate.out, "OK: tiny: 6 replicates (3 sweep points with 2 replicates each)\n");
    EXPECT_EQ(validate.err, "");
  }
  EXPECT_EQ(files_below(directory.path()).size(), 1U);
}

TEST(Program, ValidateReadsTheFilesOfAStartWithDigests) {
  const TemporaryDirectory directory;
  auto manifest = test::good_manifest();
  manifest["start"] = {{"packing", "absent.gsd"}, {"digests", {"0000000000000000"}}};
  manifest["replicates"] = 1;
  test::write_text(directory / "m.json", manifest.dump());
  for (const std::string command : {"validate", "run"}) {
    const auto ended = isojam({command, "m.json"}, directory.path());
    EXPECT_EQ(ended.exit_code, 65) << command << ": " << ended.err;
    EXPECT_EQ(ended.err.rfind("isojam: error: m.json: /start/packing: ", 0), 0U) << command << ": " << ended.err;
    EXPECT_NE(ended.err.find("absent.gsd: cannot be read"), std::string::npos) << command << ": " << ended.err;
  }
}

TEST(Program, AMeasureThatIsImpossibleAtZeroPressureIsNotAdded) {
  const TemporaryDirectory directory;
  auto manifest = test::good_manifest();
  manifest["sweep"] = {{"solid", {"octahedron"}}, {"particles", {64}}};
  // A record of a failed replicate is sufficient.
  manifest["protocol"] = {{"cohesion", {{"strength", 1e-5}, {"until", "end"}}}, {"max_steps", 1}};
  manifest["measure"] = {"contacts"};
  test::write_text(directory / "m.json", manifest.dump());
  EXPECT_EQ(isojam({"run", "m.json", "-o", "results"}, directory.path()).exit_code, 1);
  const auto before = files_below(directory.path());
  const auto refused = isojam({"measure", "results", "--add", "order,modes"}, directory.path());
  EXPECT_EQ(refused.exit_code, 65);
  EXPECT_EQ(
      refused.err,
      "isojam: error: results: the measure modes is not possible at zero pressure: it needs repulsive forces or a "
      "jamming density; remove the measure from --add\n");
  EXPECT_EQ(files_below(directory.path()), before);
}

TEST(Program, AHundredThousandUnknownKeysAreRefused) {
  const TemporaryDirectory directory;
  std::string text = "{\"name\": \"a\"";
  for (int k = 0; k < 100000; ++k) text += ", \"k" + std::to_string(k) + "\": 1";
  test::write_text(directory / "m.json", text + "}");
  // A time in proportion to the square of the number of keys would be a minute.
  const auto ended = test::shell("ulimit -t 30; $ISOJAM validate m.json", directory.path());
  EXPECT_EQ(ended.exit_code, 65) << ended.err;
  EXPECT_EQ(lines_of(ended.err), 101) << ended.err.substr(0, 1000);
}

TEST(Program, NamesWrongAndMissingArguments) {
  const TemporaryDirectory directory;
  struct Case {
    std::vector<std::string> arguments;
    std::string says;
  };
  const std::vector<Case> cases{
      {{"ruN", "m.json"}, "unknown command \"ruN\"; did you mean \"run\"?"},
      {{"vaildate", "m.json"}, "unknown command \"vaildate\"; did you mean \"validate\"?"},
      {{"zzzzzz"}, "unknown command \"zzzzzz\"; expected one of \"run\", \"validate\""},
      {{"run", "m.json", "--thread=2"}, "unknown option \"--thread\"; did you mean \"--threads\"?"},
      {{"run", "m.json", "--colour", "never"}, "unknown option \"--colour\"; did you mean \"--color\"?"},
      {{"run", "--dryrun"}, "unknown option \"--dryrun\"; did you mean \"--dry-run\"?"},
      {{"--helpp"}, "unknown option \"--helpp\"; did you mean \"--help\"?"},
      {{"run", "m.json", "--jobs", "2"}, "unknown option \"--jobs\"; did you mean \"-j\"?"},
      {{"status", ".", "--jobs"}, "unknown option \"--jobs\"; expected one of \"--help\", \"--version\""},
      {{"aggregate", ".", "--exclude", "crystal"},
       "--exclude: unknown flag \"crystal\"; did you mean \"crystalline\"?"},
      {{"-q"}, "unknown option \"-q\"; expected one of \"--help\""},
      {{}, "a command is required; see \"isojam --help\""},
      {{"run"}, "MANIFEST is required; see \"isojam run --help\""},
      {{"run", "m.json", "one", "two"}, "unexpected argument \"one\"; see \"isojam run --help\""},
      {{"--messages"}, "--messages needs a value; expected one of \"text\", \"json\""},
      {{"run", "m.json", "-j"}, "--threads needs a value; expected an integer"},
      {{"run", "m.json", "-o"}, "--output needs a value; expected a path"},
      {{"run", "m.json", "-j", "1", "-j", "2"}, "--threads is given 2 times; give it once"},
      {{"completions"}, "shell is required; expected one of \"bash\", \"zsh\", \"fish\""},
      {{"chart", "c.json", "--full", "-o", "chart"}, "CONFIG and --full cannot be combined; remove one of them"},
  };
  for (const auto& wrong : cases) {
    const auto run = isojam(wrong.arguments, directory.path());
    EXPECT_EQ(run.exit_code, 2) << wrong.says;
    EXPECT_EQ(run.err.rfind("isojam: error: " + wrong.says, 0), 0U) << run.err;
    EXPECT_EQ(lines_of(run.err), 1) << run.err;
  }
}

TEST(Program, AMissingOrEmptyDirectoryHasTheSameErrorInEveryCommand) {
  const TemporaryDirectory directory;
  std::filesystem::create_directory(directory / "empty");
  for (const auto& [name, says] :
       {std::pair{"nowhere", "no such directory"}, std::pair{"empty", "contains no results"}}) {
    const auto expected =
        std::string("isojam: error: ") + name + ": " + says + "; give a results directory of isojam run\n";
    for (const std::vector<std::string>& command : {std::vector<std::string>{"status", name},
                                                    {"rerun", name, "x"},
                                                    {"aggregate", name},
                                                    {"report", name},
                                                    {"measure", name},
                                                    {"export", name, "x", "--format", "gsd", "-o", "x.gsd"}}) {
      const auto run = isojam(command, directory.path());
      EXPECT_EQ(run.exit_code, 2) << command[0];
      EXPECT_EQ(run.err, expected) << command[0];
    }
  }
}

TEST(Program, AFileForADirectoryAndADirectoryForAFileAreRefusedWithTheRemedy) {
  const TemporaryDirectory directory;
  test::write_text(directory / "m.json", test::good_manifest().dump());
  std::filesystem::create_directory(directory / "r");
  std::filesystem::create_directory(directory / "empty");
  test::write_text(directory / "r/manifest.json", test::good_manifest().dump());
  for (const std::string command : {"aggregate", "status", "report", "measure"}) {
    const auto run = isojam({command, "m.json"}, directory.path());
    EXPECT_EQ(run.exit_code, 2) << command;
    EXPECT_EQ(run.err, "isojam: error: m.json: is not a directory; give a results directory of isojam run\n");
  }
  for (const std::string command : {"run", "validate"}) {
    EXPECT_EQ(isojam({command, "r"}, directory.path()).err,
              "isojam: error: r: is a directory; give a manifest, for example r/manifest.json\n");
    EXPECT_EQ(isojam({command, "empty"}, directory.path()).err,
              "isojam: error: empty: is a directory; give a manifest\n");
  }
}

TEST(Program, WrongOutputsAreRefusedWithTheRemedy) {
  const TemporaryDirectory directory;
  test::write_text(directory / "m.json", test::good_manifest().dump());
  std::filesystem::create_directories(directory / "r/records");
  test::write_text(directory / "r/manifest.json", test::good_manifest().dump());
  for (const auto& [command, says] : std::vector<std::pair<std::vector<std::string>, std::string>>{
           {{"run", "m.json", "-o", "m.json"}, "m.json: is a file; give a directory with -o"},
           {{"aggregate", "r"}, "r: contains no records yet; run its manifest first"},
           {{"manual", "-o", "r"}, "r: is a directory; give a file"},
           {{"manual", "-o", "no/m.1"}, "no: no such directory; create it, or choose another output"}}) {
    const auto run = isojam(command, directory.path());
    EXPECT_EQ(run.exit_code, 2) << says;
    EXPECT_EQ(run.err, "isojam: error: " + says + "\n");
  }
  std::filesystem::remove(directory / "r/records");
  test::write_text(directory / "r/records", "");
  const auto run = isojam({"aggregate", "r"}, directory.path());
  EXPECT_EQ(run.exit_code, 2);
  EXPECT_EQ(run.err,
            "isojam: error: r/records: is a file instead of a folder; remove it, or choose another results "
            "directory\n");
}

TEST(Program, ColourIsUsedOnRequest) {
  const TemporaryDirectory directory;
  for (const auto& [when, coloured] : {std::pair{"always", true}, {"never", false}, {"auto", false}}) {
    const auto run = isojam({"--color", when, "validate", "absent.json"}, directory.path());
    EXPECT_EQ(run.err.find('\033') != std::string::npos, coloured) << when;
    const auto after = isojam({"validate", "absent.json", "--color", when}, directory.path());
    EXPECT_EQ(after.err, run.err) << "options may follow the command";
  }
}

}  // namespace
}  // namespace isojam
