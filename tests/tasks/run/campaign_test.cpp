#include "tasks/run/campaign.hpp"
#include "tasks/records/summary.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <set>

#include "tasks/tables/aggregate.hpp"
#include "tasks/tables/table_of.hpp"
#include "tests/tasks/support/bad_manifests.hpp"
#include "tests/tasks/support/support.hpp"

namespace isojam {
namespace {

using test::TemporaryDirectory;

constexpr auto phi_j_column = std::size_t{0};

Manifest manifest_of(const Json& replicates) {
  auto json = test::good_manifest();
  json["sweep"]["particles"] = {64, 70, 80};
  json["replicates"] = replicates;
  return parse_manifest(json.dump(), "m.json");
}

Manifest with_goal() { return manifest_of({{"min", 8}, {"max", 30}, {"quantity", "phi_j"}, {"half_width", 0.006}}); }

/// Runs a campaign to its end and returns the names of its replicates. If `reversed`, records the outcomes of each
/// round in reverse order.
std::vector<std::string> finish(Campaign& campaign, const Store& store, bool reversed, int at_most = 1 << 30) {
  std::vector<std::string> given;
  while (campaign.open_round()) {
    std::vector<ReplicateSpec> specs;
    while (auto spec = campaign.next()) specs.push_back(*spec);
    if (reversed) std::reverse(specs.begin(), specs.end());
    for (const auto& spec : specs) {
      if (at_most-- == 0) return given;
      store.write(test::made_up_outcome(spec));
      given.push_back(replicate_name(spec));
    }
  }
  return given;
}

std::vector<std::string> run_all(const std::filesystem::path& directory, const Manifest& manifest,
                                 const Shard& shard = {}, bool reversed = false, int at_most = 1 << 30) {
  const Plan plan(manifest);
  const Store store(directory, manifest, test::unheard);
  Campaign campaign(plan, manifest.replicates, shard, store);
  return finish(campaign, store, reversed, at_most);
}

TEST(Campaign, ReturnsEachMissingReplicateOnce) {
  const TemporaryDirectory directory;
  const auto manifest = manifest_of(5);
  const Plan plan(manifest);
  const Store store(directory.path(), manifest, test::unheard);
  store.write(test::made_up_outcome(plan[3]));
  auto failed = test::made_up_outcome(plan[7]);
  failed.failure = Failure{"jam", "made up"};
  store.write(failed);
  store.write(test::made_up_outcome(plan[9]));
  test::write_text(store.record_path(plan[9]), "{");

  Campaign campaign(plan, manifest.replicates, {}, store);
  ASSERT_TRUE(campaign.open_round());
  EXPECT_EQ(campaign.round_size().replicates, 15U);
  EXPECT_EQ(campaign.round_size().recorded, 3U) << "a damaged record is found when its turn comes";
  double work = 0;
  for (const std::size_t k : {0, 1, 2, 4, 5, 6, 8, 10, 11, 12, 13, 14})
    work += estimated_cost(plan[k], false).cpu_seconds;
  EXPECT_NEAR(campaign.round_size().work, work, 1e-12 * work);
  Campaign again(plan, manifest.replicates, {}, store);
  const auto given = finish(again, store, false);
  EXPECT_EQ(std::set(given.begin(), given.end()).size(), given.size());
  EXPECT_EQ(given.size(), 13U);
  EXPECT_EQ(again.failed(), 1);
  EXPECT_TRUE(run_all(directory.path(), manifest).empty()) << "all is there";
}

/// Names of the replicates up to the one where the rule ends each point, from the values of all replicates.
std::set<std::string> expected_names(const Manifest& manifest) {
  const Plan plan(manifest);
  std::set<std::string> names;
  for (std::size_t point = 0; point < plan.points(); ++point) {
    std::vector<std::optional<double>> values;
    for (int r = 0; r < plan.replicates(); ++r)
      values.emplace_back(test::made_up_outcome(plan.at(point, r)).jam.phi_j->density);
    const auto advance = advance_of(manifest.replicates, values);
    EXPECT_TRUE(advance.finished);
    for (int r = 0; r < advance.wanted; ++r) names.insert(replicate_name(plan.at(point, r)));
  }
  return names;
}

TEST(Campaign, EndsWhenTheGoalIsMet) {
  const auto manifest = with_goal();
  const auto expected = expected_names(manifest);
  EXPECT_GT(expected.size(), 12U);
  EXPECT_LT(expected.size(), 90U);
  for (const bool reversed : {false, true}) {
    const TemporaryDirectory directory;
    const auto given = run_all(directory.path(), manifest, {}, reversed);
    EXPECT_EQ(std::set(given.begin(), given.end()), expected);
    EXPECT_EQ(given.size(), expected.size());
  }
  // Interrupted many times.
  const TemporaryDirectory directory;
  std::set<std::string> given;
  for (int process = 0; process < 100; ++process) {
    const auto more = run_all(directory.path(), manifest, {}, process % 2 == 0, 3);
    if (more.empty()) break;
    given.insert(more.begin(), more.end());
  }
  EXPECT_EQ(given, expected);
}

/// Every third replicate is a crystal with another density.
Outcome partly_crystalline(const ReplicateSpec& spec) {
  auto outcome = test::made_up_outcome(spec);
  if (spec.replicate % 3 == 1) {
    outcome.measured.at(Measure::contacts).flags = {"crystalline"};
    outcome.jam.phi_j->density += 0.05;
  }
  return outcome;
}

TEST(Campaign, TheGoalIgnoresExcludedReplicates) {
  auto manifest = with_goal();
  manifest.replicates.max = 60;
  for (const bool excluding : {true, false}) {
    if (!excluding) manifest.exclude.clear();
    const TemporaryDirectory directory;
    const Plan plan(manifest);
    const Store store(directory.path(), manifest, test::unheard);
    Campaign campaign(plan, manifest.replicates, {}, store);
    while (campaign.open_round()) {
      while (const auto spec = campaign.next()) store.write(partly_crystalline(*spec));
    }
    for (const auto& row : table_of({directory.path().string()}, test::unheard).rows) {
      ASSERT_TRUE(row.goal);
      EXPECT_EQ(row.goal->met, excluding) << row.particles << ": " << row.goal->half_width.value_or(-1);
      EXPECT_EQ(row.goal->needed, row.replicates) << "the campaign ends where the table says";
      EXPECT_EQ(row.replicates == 60, !excluding) << row.replicates;
      EXPECT_EQ(*row.goal->half_width, *row.estimates[phi_j_column].half_width);
    }
  }
}

TEST(Campaign, ShardsReturnEachReplicateOnce) {
  for (const auto& manifest : {manifest_of(5), with_goal()}) {
    const TemporaryDirectory whole, parts;
    const auto all = run_all(whole.path(), manifest);
    std::vector<std::string> given;
    for (const int index : {2, 0, 1}) {
      const auto part = run_all(parts.path(), manifest, {index, 3});
      EXPECT_FALSE(part.empty());
      given.insert(given.end(), part.begin(), part.end());
    }
    EXPECT_EQ(std::set(given.begin(), given.end()), std::set(all.begin(), all.end()));
    EXPECT_EQ(given.size(), all.size());
  }
}

TEST(Campaign, AHundredThousandReplicatesStartAtOnce) {
  const TemporaryDirectory directory;
  const auto manifest = manifest_of(33334);
  const Plan plan(manifest);
  EXPECT_GT(plan.size(), 100000U);
  const Store store(directory.path(), manifest, test::unheard);
  Campaign campaign(plan, manifest.replicates, {}, store);
  ASSERT_TRUE(campaign.open_round());
  EXPECT_EQ(campaign.round_size().replicates, plan.size());
  EXPECT_EQ(replicate_name(*campaign.next()), "dodecahedron-N64-r0000");
}

TEST(Cost, GrowsWithSizeAndFitsInMemory) {
  const auto manifest = manifest_of(1);
  const Plan plan(manifest);
  EXPECT_LT(estimated_cost(plan[0], false).cpu_seconds, estimated_cost(plan[2], false).cpu_seconds);
  EXPECT_LT(estimated_cost(plan[0], false).disk_bytes, estimated_cost(plan[0], true).disk_bytes);
  EXPECT_EQ(replicates_in_flight(8, 1e9, std::numeric_limits<double>::infinity()), 8) << "unknown";
  EXPECT_EQ(replicates_in_flight(8, 1e9, 0), 1) << "a limit is exceeded";
  EXPECT_EQ(replicates_in_flight(8, 1e9, 1e12), 8);
  EXPECT_EQ(replicates_in_flight(8, 1e9, 5e9), 4);
  EXPECT_EQ(replicates_in_flight(8, 1e9, 1e8), 1) << "one always";
}

}  // namespace
}  // namespace isojam
