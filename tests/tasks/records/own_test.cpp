#include <gtest/gtest.h>
#include <sys/stat.h>

#include <thread>

#include "tasks/io/file.hpp"
#include "tasks/io/input_error.hpp"
#include "tasks/io/sealed.hpp"
#include "tasks/records/record.hpp"
#include "tasks/records/store.hpp"
#include "tasks/records/survey.hpp"
#include "tasks/tables/table_of.hpp"
#include "tests/tasks/support/bad_manifests.hpp"
#include "tests/tasks/support/support.hpp"

namespace isojam {
namespace {

namespace fs = std::filesystem;
using test::unheard;

Manifest manifest_with(int seed) {
  auto json = test::good_manifest();
  json["seed"] = seed;
  json["replicates"] = 3;
  json["keep_path"] = true;
  return parse_manifest(json.dump(), "m.json");
}

/// A directory with made-up outcomes.
class Own : public testing::Test {
 protected:
  void SetUp() override {
    for (const auto& spec : plan_) store_.write(test::made_up_outcome(spec));
  }
  fs::path path(const std::string& folder, std::size_t k) const {
    return here_ / folder / (replicate_name(plan_[k]) + ".json");
  }
  /// Changes a document and gives it a new checksum.
  static void change(const fs::path& file, const std::function<void(Json&)>& work) {
    auto json = read_sealed(file.string());
    json.erase("checksum");
    work(json);
    test::write_text(file, sealed(json));
  }
  /// Checks that no reader accepts the files of replicate 0, and that the only message names this file.
  void expect_not_held(const fs::path& file) {
    warnings_.said.clear();
    EXPECT_FALSE(store_.recorded(plan_[0]));
    ASSERT_EQ(warnings_.said.size(), 1U);
    EXPECT_NE(warnings_.said[0].find(file.string()), std::string::npos) << warnings_.said[0];
    const auto surveys = surveys_of(here_.path(), {Plan(manifest_)});
    EXPECT_EQ(surveys.damaged.size(), 1U);
    int recorded = 0;
    for (const auto& point : surveys.of_plans.at(0).points) recorded += point.recorded;
    EXPECT_EQ(recorded, static_cast<int>(plan_.size()) - 1);
  }

  const Manifest manifest_ = manifest_with(7);
  const std::vector<ReplicateSpec> plan_ = test::make_plan(manifest_);
  test::TemporaryDirectory here_;
  test::Warnings warnings_;
  const Store store_{here_.path(), manifest_, warnings_.warn()};
};

TEST_F(Own, PackingsAndPathsBelongToTheirRecord) {
  for (const std::string folder : {"packings", "paths"}) {
    const auto own = read_text(path(folder, 0));
    fs::copy_file(path(folder, 1), path(folder, 0), fs::copy_options::overwrite_existing);
    expect_not_held(path(folder, 0));
    test::write_text(path(folder, 0), own);
    for (const std::string key : {"schema", "replicate", "spec_digest", "result_digest"}) {
      change(path(folder, 0), [&](Json& json) { json[key] = "another"; });
      expect_not_held(path(folder, 0));
      test::write_text(path(folder, 0), own);
    }
    EXPECT_TRUE(store_.recorded(plan_[0]));
  }
}

TEST_F(Own, AReportDoesNotUseAForeignPacking) {
  const auto held = read_record(here_.path(), replicate_name(plan_[0]));
  ASSERT_TRUE(read_nearest_packing(here_.path(), held));
  fs::copy_file(path("packings", 1), path("packings", 0), fs::copy_options::overwrite_existing);
  EXPECT_THROW(read_nearest_packing(here_.path(), held), InputError);
  fs::remove(path("packings", 0));
  EXPECT_FALSE(read_nearest_packing(here_.path(), held));
}

TEST_F(Own, ARecordHasTheDigestThatItStates) {
  change(path("records", 0), [](Json& json) { json["phi_j"]["phi_j"] = 0.7; });
  EXPECT_FALSE(store_.recorded(plan_[0]));
  EXPECT_THROW(for_each_record(here_.path(), unheard, [](const auto&) {}), InputError);
}

TEST_F(Own, EveryErrorOfAFileHasARemedy) {
  const std::string recompute = "; run the manifest again in this directory to recompute the replicate";
  const auto record = read_text(path("records", 0));
  const auto expect = [&](const fs::path& file, const std::string& says, const std::string& remedy) {
    std::string said;
    try {
      check_companions(here_.path(), read_record(here_.path(), replicate_name(plan_[0])), true);
    } catch (const InputError& error) {
      said = error.what();
    }
    EXPECT_EQ(said, file.string() + ": " + says + remedy);
    // A run recomputes the replicate anyway, so its warning has no remedy.
    warnings_.said.clear();
    EXPECT_FALSE(store_.recorded(plan_[0]));
    EXPECT_EQ(warnings_.said, std::vector<std::string>{file.string() + ": " + says + "; the replicate is recomputed"});
    test::write_text(path("records", 0), record);
  };
  const auto file = path("records", 0);
  change(file, [](Json& json) { json["phi_j"]["phi_j"] = 0.7; });
  expect(file, "/result_digest: the record was changed: its result does not match its digest", recompute);
  change(file, [](Json& json) { json["schema"] = "isojam.replicate.v9"; });
  expect(file, "/schema: another version of isojam wrote this file, in the format isojam.replicate.v9",
         "; run its manifest again in another directory, or use that version");
  change(file, [](Json& json) { json.erase("spec"); });
  expect(file, "/spec: the required key is missing", recompute);
  test::write_text(file, record.substr(0, 300));
  expect(file, "/checksum: the file is damaged: its content does not match its checksum", recompute);
  test::write_text(file, "{}");
  expect(file, "/checksum: the file was not written by isojam, or is incomplete: it has no checksum", recompute);
  fs::remove(path("packings", 0));
  expect(path("packings", 0), "the file is missing", recompute);
}

TEST_F(Own, ARecordIsOfTheReplicateInItsName) {
  fs::copy_file(path("records", 1), path("records", 0), fs::copy_options::overwrite_existing);
  expect_not_held(path("records", 0));
  EXPECT_THROW(table_of({here_.path().string()}, unheard), InputError);
}

TEST_F(Own, RecordsOfAnotherManifestAreLeftOut) {
  const auto others = test::make_plan(manifest_with(8));
  test::write_text(path("records", 0), sealed(make_record(test::made_up_outcome(others[0]))));
  const auto table = table_of({here_.path().string()}, warnings_.warn());
  int counted = 0;
  for (const auto& row : table.rows) counted += row.replicates;
  EXPECT_EQ(counted, static_cast<int>(plan_.size()) - 1);
  ASSERT_EQ(warnings_.said.size(), 1U);
  EXPECT_NE(warnings_.said[0].find("no manifest requests the settings of 1 "), std::string::npos) << warnings_.said[0];
}

TEST_F(Own, DifferentBuildsAreReported) {
  EXPECT_EQ(table_of({here_.path().string()}, warnings_.warn()).builds.size(), 1U);
  EXPECT_TRUE(warnings_.said.empty());
  change(path("records", 0), [](Json& json) { json["provenance"]["git"] = "another"; });
  EXPECT_EQ(table_of({here_.path().string()}, warnings_.warn()).builds.size(), 2U);
  ASSERT_EQ(warnings_.said.size(), 1U);
  EXPECT_NE(warnings_.said[0].find("2 builds"), std::string::npos) << warnings_.said[0];
}

TEST_F(Own, PipesAndDevicesAreDamage) {
  for (const std::string folder : {"records", "packings", "paths"}) {
    const auto own = read_text(path(folder, 0));
    fs::remove(path(folder, 0));
    ASSERT_EQ(mkfifo(path(folder, 0).c_str(), 0600), 0);
    expect_not_held(path(folder, 0));
    fs::remove(path(folder, 0));
    fs::create_symlink("/dev/zero", path(folder, 0));
    expect_not_held(path(folder, 0));
    fs::remove(path(folder, 0));
    test::write_text(path(folder, 0), own);
  }
  const auto checkpoint = here_ / "checkpoints" / (replicate_name(plan_[0]) + ".json");
  ASSERT_EQ(mkfifo(checkpoint.c_str(), 0600), 0);
  EXPECT_FALSE(store_.checkpoint(plan_[0]));
}

TEST_F(Own, NestingWithoutEndIsDamage) {
  constexpr int deep = 1000000;
  Json json = read_sealed(path("records", 0).string());
  json.erase("checksum");
  auto text = sealed(json);
  const std::string place = "\n  \"states\": [";
  const auto at = text.find(place) + place.size();
  text.insert(at, std::string(deep, '[') + std::string(deep, ']') + ",");
  test::write_text(path("records", 0), test::sealed_again(text));
  expect_not_held(path("records", 0));
  EXPECT_NE(warnings_.said[0].find("nested"), std::string::npos) << warnings_.said[0];
}

TEST_F(Own, ResultsOfAnotherVersionAreRefusedWithARemedy) {
  change(here_.path() / "manifest.json", [](Json& json) { json["protocol"]["consolidation"] = "relaxed"; });
  try {
    own_manifest(here_.path());
    FAIL() << "accepted";
  } catch (const InputError& error) {
    EXPECT_EQ(error.what(), (here_.path() / "manifest.json").string() +
                                ": /protocol/consolidation: the results were written by another version of isojam, "
                                "such as 0.1.0; run their manifest again in another directory");
  }
}

TEST(Rivals, OneOfThemGetsAFreshDirectory) {
  constexpr int rounds = 40;
  for (int round = 0; round < rounds; ++round) {
    const test::TemporaryDirectory directory;
    std::vector<std::string> refusals(2);
    std::vector<std::optional<Store>> stores(2);
    {
      std::vector<std::jthread> rivals;
      for (std::size_t k = 0; k < 2; ++k) {
        rivals.emplace_back([&, k] {
          try {
            stores[k].emplace(directory / "r", manifest_with(7 + static_cast<int>(k)), unheard);
          } catch (const FileError& error) {
            refusals[k] = error.what();
          }
        });
      }
    }
    const bool first_lost = !refusals[0].empty();
    ASSERT_NE(first_lost, !refusals[1].empty()) << refusals[0] << " | " << refusals[1];
    ASSERT_NE(refusals[first_lost ? 0 : 1].find("another process of isojam"), std::string::npos);
    EXPECT_EQ(own_manifest(directory / "r").seed, first_lost ? 8U : 7U);
  }
}

}  // namespace
}  // namespace isojam
