#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <limits>

#include "tasks/io/file.hpp"
#include "tasks/io/parse.hpp"
#include "tasks/io/sealed.hpp"
#include "tasks/manifest/manifest.hpp"
#include "tasks/records/record.hpp"
#include "tasks/records/summary.hpp"
#include "tasks/tables/aggregate.hpp"
#include "tasks/tables/tables.hpp"
#include "tests/tasks/support/bad_manifests.hpp"
#include "tests/tasks/support/schema.hpp"
#include "tests/tasks/support/support.hpp"

namespace isojam {
namespace {

using test::violations;

TEST(Schemas, AreThoseOfTheProgram) {
  int checked = 0;
  for (const auto& file : std::filesystem::directory_iterator(ISOJAM_SOURCE_DIR "/schemas")) {
    const auto name = file.path().stem().stem().string();
    const auto made = test::isojam({"schema", name}, ISOJAM_SOURCE_DIR);
    if (name.starts_with("chart") && made.exit_code != 0) continue;  // a build without pages does not know it
    EXPECT_EQ(made.out, read_file(file.path())) << name << ": make schemas";
    ++checked;
  }
  EXPECT_GE(checked, 5);
}

TEST(ManifestSchema, AcceptsWhatTheProgramAccepts) {
  auto swept = test::good_manifest();
  swept["$schema"] = "../schemas/manifest.schema.json";
  for (const auto& one : all_parameters()) swept["sweep"][one.name] = Json{written(one.field)};
  auto sequential = test::good_manifest();
  sequential["replicates"] = {{"min", 4}, {"max", 40}, {"quantity", "phi_j"}, {"half_width", 0.003}};
  sequential["keep_path"] = true;
  sequential["exclude"] = {"not_stable"};
  sequential["sweep"]["step_fraction"] = {0.2, 0.35};
  sequential["base"] = {{"step_fraction", 0.2}};
  for (const auto& manifest : {test::good_manifest(), test::tiny_manifest(), swept, sequential}) {
    EXPECT_EQ(violations("manifest", manifest), "") << manifest;
    const auto canonical = to_json(parse_manifest(manifest.dump(), "manifest"));
    EXPECT_EQ(violations("manifest", canonical), "") << canonical;
  }
}

TEST(ManifestSchema, AcceptsEveryExample) {
  const std::filesystem::path examples = std::string(ISOJAM_SOURCE_DIR) + "/examples";
  if (!std::filesystem::exists(examples)) GTEST_SKIP() << "no examples in this tree";
  int seen = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(examples)) {
    // Results that belong to an example are not manifests.
    if (entry.path().extension() != ".json" || entry.path().parent_path().filename() == "data") continue;
    ++seen;
    const auto text = read_text(entry.path().string());
    EXPECT_NO_THROW(parse_manifest(text, entry.path().string()));
    EXPECT_EQ(violations("manifest", parse_json(text, entry.path().string())), "") << entry.path();
  }
  EXPECT_GT(seen, 0);
}

TEST(ManifestSchema, RejectsWhatItCanExpress) {
  int refused = 0;
  for (const auto& bad : test::bad_manifests()) {
    if (!bad.schema_can_tell) continue;
    EXPECT_NE(violations("manifest", parse_json(bad.text, bad.name)), "") << bad.name << ": " << bad.text;
    ++refused;
  }
  EXPECT_GT(refused, 40);
}

std::vector<Json> made_up_records() {
  auto manifest = test::good_manifest();
  manifest["sweep"]["target_energy"] = {1e-6, 3.2e-5};
  std::vector<Json> records;
  for (const auto& spec : test::make_plan(parse_manifest(manifest.dump(), "good"))) {
    auto outcome = test::made_up_outcome(spec);
    auto contacts = test::made_up_contacts(9);
    if (records.empty()) contacts.Q6 = 0.5;
    if (records.size() == 1) contacts.face_face.verdict = FitVerdict::collapsed;
    test::set_nearest_contacts(outcome, contacts);
    if (records.size() == 2) {
      outcome.jam.status = JamStatus::step_limit;
      outcome.jam.phi_j.reset();
      outcome.jam.path.front().summary.residual = std::numeric_limits<double>::infinity();
      outcome.failure = failure_of(outcome.jam);
    }
    if (records.size() == 3) outcome.measured.clear();
    records.push_back(test::record_on_disk(outcome));
  }
  return records;
}

TEST(RecordSchema, UnbalancedStatesAreFlagged) {
  auto outcome = test::made_up_outcome(Plan(parse_manifest(test::good_manifest().dump(), "manifest")).at(0, 0));
  EXPECT_TRUE(flags_of(outcome).empty());
  outcome.jam.path[static_cast<std::size_t>(outcome.jam.state_steps[1])].summary.reason = StopReason::energy_change;
  outcome.jam.status = JamStatus::goal_not_reached;
  EXPECT_EQ(flags_of(outcome), (std::vector<Flag>{Flag::goal_not_reached, Flag::not_balanced}));
  EXPECT_EQ(violations("record", parse_json(sealed(make_record(outcome)), "record")), "");
}

/// Outcome of a replicate with measured vibrations and moduli.
Outcome with_scaling() {
  auto manifest = test::good_manifest();
  manifest["measure"] = {"contacts", "order", "clusters", "modes", "moduli"};
  auto outcome = test::made_up_outcome(Plan(parse_manifest(manifest.dump(), "good")).at(0, 0));
  for (const auto& [what, key] : {std::pair{Measure::modes, "modes"}, {Measure::moduli, "moduli"}}) {
    outcome.measured[what].states.assign(outcome.jam.states.size(), Json::object());
    outcome.measured[what].replicate[key] = Json::object();
  }
  return outcome;
}

TEST(RecordSchema, FailedRecordsHaveReasonsInPlaceOfResults) {
  auto outcome = with_scaling();
  outcome.failure = Failure{"modes", "made up"};
  outcome.measured.clear();
  const auto failed = test::record_on_disk(outcome);
  EXPECT_EQ(violations("record", failed), "");
  for (const std::string key : {"flags", "phi_j", "nearest"}) {
    EXPECT_TRUE(failed.at(key).is_null()) << key;
    EXPECT_EQ(failed.at(key + "_reason"), "the replicate failed");
  }
  for (const auto* key : {"modes", "moduli", "rearrangements"}) EXPECT_FALSE(failed.contains(key)) << key;
  const auto summary = summarise_record(failed, "made up");
  EXPECT_TRUE(summary.failed);
  EXPECT_FALSE(summary.flagged);
  auto both = failed;
  both.erase("failure");
  EXPECT_THROW(summarise_record(both, "made up"), InputError);
}

TEST(RecordSchema, StatesHowOftenThePackingRearranged) {
  auto outcome = test::made_up_outcome(Plan(parse_manifest(test::good_manifest().dump(), "good")).at(0, 0));
  auto& path = outcome.jam.path;
  path.at(1).rearrangement = Rearrangement{0.25, 7, 3, 4.5};
  path.at(2).rearrangement = Rearrangement{0.875, 40, 2, 30};
  path.push_back(path.back());  // without a state, like the end of a branch
  path.back().lost = true;
  const auto record = test::record_on_disk(outcome);
  EXPECT_EQ(violations("record", record), "");
  EXPECT_EQ(record.at("rearrangements").dump(),
            R"({"count":2,"steps":3,"particles_moved":4.5,"contacts_lost":7.0,"contacts_gained":3.0})");
  EXPECT_FALSE(record.at("path").at(1).contains("lost"));
  EXPECT_EQ(record.at("path").at(4).at("lost"), true);
  auto damaged = record;
  damaged["path"][1]["lost"] = false;
  EXPECT_NE(violations("record", damaged), "");
  path.at(1).rearrangement.reset();
  const auto without = test::record_on_disk(outcome);
  EXPECT_EQ(violations("record", without), "");
  EXPECT_TRUE(without.at("rearrangements").at("particles_moved").is_null());

  std::vector<RecordSummary> summaries{summarise_record(record, "one"), summarise_record(without, "another")};
  summaries[1].replicate = 1;
  const auto table = aggregate(summaries);
  const auto of = [&](const std::string& name) { return table.rows.at(0).estimates[*quantity_index(name)]; };
  EXPECT_EQ(of("rearrangements").mean, 1.5);
  EXPECT_EQ(of("decompression_steps").mean, 2.5);
  EXPECT_EQ(of("contacts_lost").mean, 7);
  EXPECT_EQ(of("contacts_lost").n, 1) << "the other has none that led on";
  EXPECT_NE(to_text(table).find("\nrearrangements: "), std::string::npos) << to_text(table);
  auto earlier = record;
  earlier.erase("rearrangements");
  EXPECT_EQ(violations("record", earlier), "");
  EXPECT_FALSE(summarise_record(earlier, "earlier").values[*quantity_index("rearrangements")]);
}

TEST(TableSchema, AcceptsTables) {
  std::vector<RecordSummary> summaries;
  for (const auto& record : made_up_records()) summaries.push_back(summarise_record(record, "made up"));
  for (std::size_t n = 1; n <= summaries.size(); ++n) {
    const auto table = to_json(aggregate(std::span(summaries).first(n)));
    EXPECT_EQ(violations("tables", table), "") << table.dump(1);
    auto damaged = table;
    damaged["rows"][0].erase("failed");
    EXPECT_NE(violations("tables", damaged), "");
  }
  const Json base{{"target_energy", 1e-6}};
  const auto table = to_json(aggregate(summaries, {}, usually_excluded(), base));
  EXPECT_EQ(violations("tables", table), "") << table.dump(1);
  EXPECT_EQ(table.at("base"), base);
  ASSERT_TRUE(table.at("rows").at(1).contains("differences"));
  for (const std::string pointer : {"/base", "/rows/1/differences/pairs", "/rows/1/differences/phi_j"}) {
    auto damaged = table;
    damaged[Json::json_pointer(pointer)] = "x";
    EXPECT_NE(violations("tables", damaged), "") << pointer;
  }
  auto misspelt = table;
  misspelt["rows"][1]["differences"]["phi_i"] = table.at("rows").at(1).at("differences").at("phi_j");
  EXPECT_NE(violations("tables", misspelt), "");
}

}  // namespace
}  // namespace isojam
