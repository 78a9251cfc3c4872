#include "tasks/records/store.hpp"
#include "tasks/io/file.hpp"
#include "tasks/records/summary.hpp"

#include <gtest/gtest.h>

#include <fstream>

#include "tasks/io/input_error.hpp"
#include "tasks/packings/packing_json.hpp"
#include "tasks/records/record.hpp"
#include "tests/tasks/support/bad_manifests.hpp"
#include "tests/tasks/support/schema.hpp"
#include "tests/tasks/support/support.hpp"

namespace isojam {
namespace {

using test::TemporaryDirectory;
using test::unheard;
using test::Warnings;

Manifest manifest_with(int seed = 7, int replicates = 2) {
  auto json = test::good_manifest();
  json["seed"] = seed;
  json["replicates"] = replicates;
  return parse_manifest(json.dump(), "m.json");
}

int count_records(const std::filesystem::path& directory) {
  int count = 0;
  for_each_record(directory, unheard, [&](const RecordedReplicate&) { ++count; });
  return count;
}

TEST(Store, PackingsConformToTheirSchema) {
  RandomStream random{3};
  const Mixture mixture({{SolidKind::cube, .5}, {SolidKind::octahedron, .5, {.from = 1.4}}}, "");
  DoubleDoubleMatrix shear;
  shear.high(0, 1) = .1;
  shear.low(0, 1) = 1e-18;
  const auto alike = random_packing(platonic(SolidKind::cube), 60, .5, random);
  for (const auto& packing : {alike, random_packing(mixture.particles(60), .4, random), deformed(alike, shear)}) {
    Json file;
    file["schema"] = packing_schema;
    file["checksum"] = file["spec_digest"] = file["result_digest"] = "0123456789abcdef";
    file["replicate"] = "cube-N60-r0000";
    file.update(to_json(packing));
    EXPECT_EQ(test::violations("packing", file), "");
    for (const auto* needed : {"positions_low", "orientations", "density", packing.cell.is_cube() ? "side" : "cell_low",
                               packing.solids.is_uniform() ? "solid" : "size"}) {
      auto without = file;
      without.erase(needed);
      EXPECT_NE(test::violations("packing", without), "") << needed;
    }
    file["delta_phi"] = 0.1;
    EXPECT_NE(test::violations("packing", file), "") << "the record says that";
  }
}

TEST(NameLocks, AreOfTheirHolderAndNotOfTheProcess) {
  const TemporaryDirectory directory;
  const NameLocks one(directory / "locks");
  ASSERT_TRUE(one.take("a"));
  {
    const NameLocks other(directory / "locks");
    EXPECT_FALSE(other.take("a"));
    EXPECT_TRUE(other.take("b"));
  }
  EXPECT_FALSE(NameLocks(directory / "locks").take("a")) << "a holder that ends releases only its own";
  one.release("a");
  EXPECT_TRUE(NameLocks(directory / "locks").take("a"));
}

TEST(Store, ADamagedRecordBeyondThePlanIsOnlyReported) {
  const TemporaryDirectory directory;
  { const Store store(directory.path(), manifest_with(), unheard); }
  const auto path = directory / "records/cube-N64-r0000.json";
  test::write_text(path, "{");
  Warnings warnings;
  const auto plan = test::make_plan(manifest_with());
  Store(directory.path(), manifest_with(), warnings.warn()).write(test::made_up_outcome(plan[0]));
  EXPECT_TRUE(warnings.said.empty()) << "a run reports it once, in its tables";
  EXPECT_EQ(read_text(path), "{");
  int count = 0;
  for_each_record(directory.path(), warnings.warn(), [&](const RecordedReplicate&) { ++count; });
  EXPECT_EQ(count, 1);
  EXPECT_EQ(warnings.said,
            std::vector<std::string>{path.string() + ": is ignored, because no manifest has such a replicate; remove "
                                                     "the file, or correct its name"});
}

TEST(Store, KeepsEveryManifestOnce) {
  const TemporaryDirectory directory;
  const auto kept = [&] {
    std::vector<int> numbers;
    for (const auto& plan : requests_in(directory.path(), unheard)) numbers.push_back(plan.replicates());
    return numbers;
  };
  std::vector<int> expected;
  for (const int asked : {2, 5, 3, 5, 5}) {
    const Store store(directory.path(), manifest_with(7, asked), unheard);
    std::erase(expected, asked);
    expected.insert(expected.begin(), asked);
    EXPECT_EQ(kept(), expected);
    EXPECT_EQ(own_manifest(directory.path()).replicates.max, asked);
  }
  // As a directory of an earlier version, which has manifest.json alone.
  std::filesystem::remove_all(directory / "manifests");
  const Store store(directory.path(), manifest_with(7, 4), unheard);
  EXPECT_EQ(kept(), (std::vector{4, 5}));
  test::write_text(directory / "manifest.json", "{");
  Warnings warnings;
  const Store again(directory.path(), manifest_with(7, 4), warnings.warn());
  EXPECT_EQ(kept(), (std::vector{4, 5})) << "the damaged file is replaced";
  EXPECT_EQ(warnings.said.size(), 1U);
}

TEST(Store, TemporariesAreNotResults) {
  const TemporaryDirectory directory;
  const auto manifest = manifest_with();
  const Store store(directory.path(), manifest, unheard);
  store.write(test::made_up_outcome(test::make_plan(manifest)[0]));
  test::write_text(directory / "records/.dodecahedron-N64-r0001.json.0123456789abcdef.tmp", "{\"half");
  for (const std::string folder : {".", "records", "packings", "checkpoints"}) {
    const auto stale = directory / folder / ".tables.json.0123456789abcdef.tmp";
    test::write_text(stale, "{\"half");
    std::filesystem::last_write_time(stale, std::filesystem::file_time_type::clock::now() - std::chrono::hours(2));
    const Store again(directory.path(), manifest, unheard);
    EXPECT_FALSE(std::filesystem::exists(stale)) << folder;
  }
  EXPECT_NO_THROW(Store(directory.path(), manifest, unheard));
  EXPECT_EQ(count_records(directory.path()), 1);
}

TEST(Store, RecordsComeInOrderUpToTheFirstDamagedOne) {
  const TemporaryDirectory directory;
  const auto manifest = manifest_with(7, 60);
  const auto plan = test::make_plan(manifest);
  const Store store(directory.path(), manifest, unheard);
  for (const auto& spec : plan) store.write(test::made_up_outcome(spec));
  test::write_text(store.record_path(plan[40]), "{");
  test::write_text(store.record_path(plan[50]), "[");
  for (int trial = 0; trial < 5; ++trial) {
    std::vector<int> seen;
    try {
      for_each_record(directory.path(), unheard,
                      [&](const RecordedReplicate& held) { seen.push_back(held.summary.replicate); });
      FAIL() << "damage went unnoticed";
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find("-r0040.json"), std::string::npos) << error.what();
    }
    ASSERT_EQ(seen.size(), 40U);
    EXPECT_TRUE(std::is_sorted(seen.begin(), seen.end()));
  }
}

}  // namespace
}  // namespace isojam
