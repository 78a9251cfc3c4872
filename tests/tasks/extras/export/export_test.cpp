#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "tasks/extras/export/formats.hpp"
#include "tasks/io/file.hpp"
#include "tasks/io/parse.hpp"
#include "tasks/io/sealed.hpp"
#include "tasks/packings/packing_json.hpp"
#include "tasks/records/store.hpp"
#include "tests/tasks/support/bad_manifests.hpp"
#include "tests/tasks/support/support.hpp"

namespace isojam {
namespace {

using test::files_below;
using test::isojam;
using test::TemporaryDirectory;

std::vector<ExportFrame> made_up_frames(SolidKind kind = SolidKind::dodecahedron) {
  RandomStream random({17});
  const auto loose = random_packing(platonic(kind), 70, 0.3, random);
  return {make_frame(strained_to(loose, 0.7), 0.02), make_frame(strained_to(loose, 0.69), 0.01)};
}

TEST(ExportFormats, WithoutAJammingPointFramesHaveNumbersForTimes) {
  auto frames = made_up_frames();
  EXPECT_NE(gsd_file(frames).find("delta_phi"), std::string::npos);
  frames[1].delta_phi.reset();
  EXPECT_EQ(gsd_file(frames).find("delta_phi"), std::string::npos) << "or the second frame would inherit the first's";
  EXPECT_EQ(vtp_file(frames[1]).find("delta_phi"), std::string::npos);
  const auto files = exported_files(frames, Exported::vtp, true, "a/b.pvd");
  ASSERT_EQ(files.size(), 3U);
  EXPECT_EQ(files[0].path, "a/b_0000.vtp");
  EXPECT_EQ(files[2].path, "a/b.pvd") << "last, as it names the others";
  EXPECT_NE(files[2].bytes.find("timestep=\"1\" part=\"0\" file=\"b_0001.vtp\""), std::string::npos) << files[2].bytes;
}

TEST(ExportFormats, NamesAreEscapedInCollections) {
  const auto xml = pvd_file(std::vector<TimedFile>{{"a&\"<b>.vtp", 0.5}});
  EXPECT_NE(xml.find("file=\"a&amp;&quot;&lt;b&gt;.vtp\""), std::string::npos) << xml;
}

/// A results directory with made-up replicates whose decompressions were kept. The last replicate failed.
class ExportCommandTest : public ::testing::Test {
 protected:
  void SetUp() override {
    auto json = test::good_manifest();
    json["keep_path"] = true;
    const auto manifest = parse_manifest(json.dump(), "m.json");
    const Store store(directory_ / "r", manifest, test::unheard);
    const Plan plan(manifest);
    for (std::size_t k = 0; k < plan.size(); ++k) {
      auto outcome = test::made_up_outcome(plan[k]);
      names_.push_back(replicate_name(plan[k]));
      if (k + 1 == plan.size()) outcome.failure = Failure{"jam", "no reason"};
      store.write(outcome);
    }
    before_ = files_below(directory_.path());
  }

  std::filesystem::path path_file(const std::string& name) const { return directory_ / ("r/paths/" + name + ".json"); }

  test::Finished run(const std::string& replicate, const std::string& format, const std::string& output,
                     bool path = false) const {
    std::vector<std::string> arguments{"export", "r", replicate, "--format", format, "-o", output};
    if (path) arguments.emplace_back("--path");
    return isojam(arguments, directory_.path());
  }

  /// Files that were added to the directory.
  std::vector<std::string> written() const {
    std::vector<std::string> names;
    for (const auto& [name, content] : files_below(directory_.path())) {
      if (!before_.contains(name)) names.push_back(name);
    }
    return names;
  }

  void expect_refused(const test::Finished& run, int exit_code, const std::string& says) const {
    EXPECT_EQ(run.exit_code, exit_code) << run.err;
    EXPECT_NE(run.err.find(says), std::string::npos) << run.err << "\nought to say: " << says;
    EXPECT_EQ(run.out, "");
    EXPECT_EQ(written(), std::vector<std::string>());
    EXPECT_TRUE(files_below(directory_.path()) == before_) << "a file has changed or gone";
  }

  TemporaryDirectory directory_;
  std::vector<std::string> names_;
  std::map<std::string, std::string> before_;
};

std::vector<std::string> sorted_lines(const std::string& text) {
  std::vector<std::string> lines;
  for (std::size_t from = 0; from < text.size();) {
    const auto end = text.find('\n', from);
    lines.push_back(text.substr(from, end - from));
    from = end + 1;
  }
  std::sort(lines.begin(), lines.end());
  return lines;
}

TEST_F(ExportCommandTest, WritesWhatItListsAndNothingElse) {
  struct Case {
    std::string format, output;
    bool path;
    std::vector<std::string> files;
  };
  const std::vector<Case> cases{
      {"gsd", "a.gsd", false, {"a.gsd"}},
      {"gsd", "b.gsd", true, {"b.gsd"}},
      {"vtp", "c.vtp", false, {"c.vtp"}},
      {"vtp", "d.vtp", true, {"d.pvd", "d_0000.vtp", "d_0001.vtp", "d_0002.vtp", "d_0003.vtp"}},
      {"xyz", "e.xyz", true, {"e.obj", "e.xyz"}},
  };
  for (const auto& [format, output, path, files] : cases) {
    before_ = files_below(directory_.path());
    const auto finished = run(names_[0], format, output, path);
    EXPECT_EQ(finished.exit_code, 0) << finished.err;
    EXPECT_EQ(sorted_lines(finished.out), files) << output;
    EXPECT_EQ(written(), files) << output;
  }
}

TEST_F(ExportCommandTest, AllReplicatesGoToADirectory) {
  for (const bool path : {false, true}) {
    before_ = files_below(directory_.path());
    const std::string output = path ? "paths" : "nearest";
    const auto finished = run("all", "gsd", output, path);
    EXPECT_EQ(finished.exit_code, 0) << finished.err;
    std::vector<std::string> expected;
    for (const auto& name : names_) expected.push_back(fmt::format("{}/{}.gsd", output, name));
    expected.pop_back();
    std::sort(expected.begin(), expected.end());
    EXPECT_EQ(written(), expected);
    EXPECT_EQ(sorted_lines(finished.out), expected);
    EXPECT_NE(finished.err.find(names_.back() + " has no packing, because the replicate failed: no reason"),
              std::string::npos)
        << finished.err;
  }
}

TEST_F(ExportCommandTest, UnknownNamesAreRejected) {
  auto misspelt = names_[0];
  std::swap(misspelt[1], misspelt[2]);
  expect_refused(run(misspelt, "gsd", "a.gsd"), 2, "did you mean \"" + names_[0] + "\"?");
  expect_refused(run("nothing like it", "gsd", "a.gsd"), 2, "expected a name such as \"" + names_[0] + "\"");
  // A path that leads to a packing is not a name.
  for (const auto& path : {"../packings/" + names_[0], "./" + names_[0], names_[0] + "/", names_[0] + ".json"}) {
    expect_refused(run(path, "gsd", "a.gsd"), 2, "unknown replicate \"" + path + "\"");
  }
  expect_refused(isojam({"export", "elsewhere", names_[0], "--format", "gsd", "-o", "a"}, directory_.path()), 2,
                 "elsewhere: no such directory");
}

TEST_F(ExportCommandTest, ImpossibleExportsAreRejected) {
  expect_refused(run(names_.back(), "gsd", "a.gsd"), 2, "has no packing, because the replicate failed: no reason");
  expect_refused(run(names_[0], "gsf", "a.gsd"), 2, "--format");
  expect_refused(run(names_[0], "gsd", "r"), 2, "r: is a directory; give a file");
  expect_refused(run(names_[0], "gsd", "absent/a.gsd"), 2, "absent: no such directory; create it");
  expect_refused(run("all", "gsd", "r/manifest.json"), 2, "r/manifest.json is a file; give a directory");
  expect_refused(run(names_[0], "xyz", "a.obj"), 2, "a.obj: this name is reserved");
  std::filesystem::remove(path_file(names_[0]));
  before_ = files_below(directory_.path());
  expect_refused(run(names_[0], "gsd", "a.gsd", true), 65, "\"keep_path\": true");
}

TEST_F(ExportCommandTest, DamagedFilesAreRejected) {
  auto path = read_json(path_file(names_[0]).string());
  path.erase("checksum");
  RandomStream random({3});
  auto other = to_json(random_packing(platonic(SolidKind::cube), 70, 0.3, random));
  other["delta_phi"] = 0.1;
  path["states"].push_back(other);
  test::write_text(path_file(names_[0]), sealed(path));
  before_ = files_below(directory_.path());
  expect_refused(run(names_[0], "gsd", "a.gsd", true), 65,
                 "/states/4: the state has other particles than the first one");

  const auto packing = directory_ / ("r/packings/" + names_[0] + ".json");
  auto text = read_text(packing.string());
  const auto digit = text.find("0.", text.find("positions"));
  text[digit + 3] = text[digit + 3] == '1' ? '2' : '1';
  test::write_text(packing, text);
  before_ = files_below(directory_.path());
  expect_refused(run(names_[0], "gsd", "a.gsd"), 65, "damaged");
}

}  // namespace
}  // namespace isojam
