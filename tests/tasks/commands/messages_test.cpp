#include <gtest/gtest.h>

#include <sstream>

#include "tests/tasks/support/support.hpp"

namespace isojam {
namespace {

using test::shell;

std::vector<Json> objects(const std::string& text) {
  std::vector<Json> list;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    list.push_back(parsed(line));
    EXPECT_TRUE(list.back().at("kind").is_string() && list.back().at("text").is_string()) << line;
  }
  return list;
}

Json small_manifest() {
  auto manifest = test::tiny_manifest();
  manifest["measure"] = {"contacts"};
  manifest["sweep"]["particles"] = {24};
  manifest["replicates"] = 2;
  return manifest;
}

TEST(Messages, EveryErrorOfAManifestHasItsPartsInJson) {
  const test::TemporaryDirectory here;
  auto manifest = small_manifest();
  manifest["seed"] = -1;
  manifest["protocol"] = {{"target_energi", 1e-5}};
  test::write_text(here / "m.json", manifest.dump());
  const auto text = shell("$ISOJAM validate m.json", here.path());
  const auto json = shell("$ISOJAM --messages json validate m.json", here.path());
  EXPECT_EQ(json.exit_code, 65);
  const auto errors = objects(json.err);
  ASSERT_EQ(errors.size(), 2U) << json.err;
  std::string lines;
  for (const auto& error : errors) {
    EXPECT_EQ(error.at("kind"), "error");
    EXPECT_EQ(error.at("file"), "m.json");
    EXPECT_FALSE(error.at("problem").get<std::string>().empty());
    lines += "isojam: error: " + error.at("text").get<std::string>() + '\n';
  }
  EXPECT_EQ(lines, text.err);
  EXPECT_EQ(errors[0].at("pointer"), "/seed");
  EXPECT_NE(errors[0].at("allowed"), "");
  EXPECT_EQ(errors[1].at("pointer"), "/protocol/target_energi");
  EXPECT_EQ(errors[1].at("suggestion"), "target_energy");
  EXPECT_NE(errors[1].at("allowed").get<std::string>().find("\"target_energy\""), std::string::npos);
  EXPECT_EQ(errors[1].at("text"), "m.json: /protocol/target_energi: unknown key; did you mean \"target_energy\"?");
}

TEST(Messages, WarningsAreObjectsAndQuietKeepsErrors) {
  const test::TemporaryDirectory here;
  auto manifest = small_manifest();
  manifest["protocol"] = {{"max_density", 0.5}};
  test::write_text(here / "m.json", manifest.dump());
  const auto warned = objects(shell("$ISOJAM validate m.json --messages json", here.path()).err);
  ASSERT_EQ(warned.size(), 1U);
  EXPECT_EQ(warned[0].at("kind"), "warning");
  EXPECT_NE(warned[0].at("text").get<std::string>().find("/protocol/max_density"), std::string::npos);
  EXPECT_EQ(shell("$ISOJAM run m.json -o r --messages json --quiet", here.path()).err, "");
  const auto missing = objects(shell("$ISOJAM validate none.json --messages json --quiet", here.path()).err);
  ASSERT_EQ(missing.size(), 1U);
  EXPECT_EQ(missing[0].at("kind"), "error");
}

TEST(Messages, AManifestOnStandardInputHasItsPathsFromTheCurrentDirectory) {
  const test::TemporaryDirectory here;
  auto manifest = small_manifest();
  manifest["solids"]["block"]["file"] = "block.off";
  manifest["sweep"] = {{"solid", {"block"}}, {"particles", {64}}};
  test::write_text(here / "block.off",
                   "OFF\n6 8 0\n1 0 0\n-1 0 0\n0 1 0\n0 -1 0\n0 0 1\n0 0 -1\n"
                   "3 0 2 4\n3 0 2 5\n3 0 3 4\n3 0 3 5\n3 1 2 4\n3 1 2 5\n3 1 3 4\n3 1 3 5\n");
  test::write_text(here / "m.json", manifest.dump());
  const auto file = shell("$ISOJAM validate m.json", here.path());
  for (const std::string line : {"$ISOJAM validate - <m.json", "cat m.json | $ISOJAM validate -"}) {
    const auto ended = shell(line, here.path());
    EXPECT_EQ(ended.exit_code, 0) << ended.err;
    EXPECT_EQ(ended.out, file.out);
  }
  manifest["seed"] = -1;
  test::write_text(here / "m.json", manifest.dump());
  const auto refused = shell("$ISOJAM run - <m.json", here.path());
  EXPECT_EQ(refused.exit_code, 65);
  EXPECT_EQ(refused.err.rfind("isojam: error: -: /seed: ", 0), 0U) << refused.err;
}

}  // namespace
}  // namespace isojam
