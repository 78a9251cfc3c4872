#include "tasks/records/abridged.hpp"

#include <gtest/gtest.h>

#include <filesystem>

#include "tasks/io/file.hpp"
#include "tasks/io/input_error.hpp"
#include "tasks/io/sealed.hpp"
#include "tasks/records/record.hpp"
#include "tasks/records/recorded.hpp"
#include "tasks/tables/aggregate.hpp"
#include "tasks/tables/tables.hpp"
#include "tests/tasks/support/bad_manifests.hpp"
#include "tests/tasks/support/support.hpp"

namespace isojam {
namespace {

std::string table_of(const RecordSummary& summary) {
  return pretty(to_json(aggregate(std::vector<RecordSummary>{summary})));
}

void expect_same(const RecordedReplicate& quick, const RecordedReplicate& whole) {
  EXPECT_EQ(table_of(quick.summary), table_of(whole.summary));
  EXPECT_EQ(quick.summary.result_digest, whole.summary.result_digest);
  EXPECT_EQ(quick.summary.spec_digest, whole.summary.spec_digest);
  EXPECT_EQ(quick.summary.measures, whole.summary.measures);
  EXPECT_EQ(quick.summary.flags, whole.summary.flags);
  EXPECT_EQ(quick.summary.settings, whole.summary.settings);
  EXPECT_EQ(quick.summary.cpu_seconds, whole.summary.cpu_seconds);
  EXPECT_EQ(quick.summary.failed, whole.summary.failed);
  EXPECT_EQ(quick.record.at("spec"), whole.record.at("spec"));
}

TEST(Abridged, KeepsWhatTablesNeed) {
  const test::TemporaryDirectory directory;
  auto manifest = test::tiny_manifest();
  manifest["sweep"]["particles"] = {24};
  manifest["replicates"] = 1;
  manifest["measure"] = {"contacts", "gaps", "order", "clusters", "modes"};
  test::write_text(directory / "m.json", manifest.dump());
  ASSERT_EQ(test::isojam({"run", "m.json", "-o", "r"}, directory.path()).exit_code, 0);
  const auto name = names_in(directory / "r/records").at(0);
  const auto whole = read_record(directory / "r", name), quick = read_record(directory / "r", name, Abridgement{});
  EXPECT_FALSE(whole.document.path.empty());
  EXPECT_TRUE(quick.document.path.empty());
  EXPECT_LT(quick.record.dump().size(), whole.record.dump().size() / 2);
  expect_same(quick, whole);
  const auto bins = Json::json_pointer("/states/0/contacts/angle_bins");
  EXPECT_EQ(quick.record.at(bins), whole.record.at(bins));
  EXPECT_TRUE(quick.summary.angles);
  EXPECT_FALSE(quick.summary.states.empty());
  const auto brief = read_record(directory / "r", name, Abridgement{States::nearest});
  EXPECT_EQ(brief.summary.values, whole.summary.values);
  ASSERT_EQ(brief.document.states.size(), 1U);
  EXPECT_EQ(brief.document.states[0].index,
            whole.document.states[static_cast<std::size_t>(*whole.document.nearest.value)].index);
}

TEST(Abridged, TablesOfNearestStatesNeedNoOtherStates) {
  const test::TemporaryDirectory directory;
  auto manifest = test::tiny_manifest();
  manifest["replicates"] = 2;
  test::write_text(directory / "m.json", manifest.dump());
  ASSERT_EQ(test::isojam({"run", "m.json", "-o", "r"}, directory.path()).exit_code, 0);
  for (const std::string format : {"text", "csv", "csv-long", "latex"}) {
    const auto brief = test::isojam({"aggregate", "r", "--format", format}, directory.path());
    const auto whole = test::isojam({"aggregate", "r", "--format", format, "-o", "t.json"}, directory.path());
    EXPECT_EQ(brief.exit_code, 0);
    EXPECT_EQ(brief.out, whole.out) << format;
  }
  const auto json = test::isojam({"aggregate", "r", "--format", "json"}, directory.path()).out;
  EXPECT_FALSE(Json::parse(json).at("rows").at(0).at("series").empty());
  EXPECT_EQ(json, read_file((directory / "t.json").string()));
}

/// A record with unusual texts and numbers, and one whose replicate failed.
std::vector<Json> unusual_records() {
  auto outcome = test::made_up_outcome(test::make_plan(parse_manifest(test::good_manifest().dump(), "m")).front());
  std::vector<Json> records{make_record(outcome)};
  outcome.jam.path.front().pressure = 5e-324;
  outcome.jam.path.front().summary.residual = std::numeric_limits<double>::infinity();
  records.push_back(make_record(outcome));
  outcome.failure = Failure{"jam", "\"states\": [\n  \"path\": [\n{ ], φ"};
  records.push_back(make_record(outcome));
  return records;
}

TEST(Abridged, LeavesOnlyListsAndOtherKeysOut) {
  for (const auto& record : unusual_records()) {
    const auto text = sealed(record);
    auto expected = parse_sealed(text, "record");
    auto shorter = parsed(abridged(text, {}));
    EXPECT_EQ(shorter.at("path"), Json::array());
    expected["path"] = Json::array();
    for (const auto& difference : Json::diff(expected, shorter))
      EXPECT_TRUE(difference.at("op") == "remove" || difference.at("value") == Json::array()) << difference;
    for (const auto* key : {"status", "flags", "phi_j", "nearest", "timing", "spec", "provenance"})
      EXPECT_EQ(shorter.at(key).size(), expected.at(key).size()) << key;
    for (auto& state : shorter.at("states")) {
      for (const auto measure : all_measures) state.erase(std::string(to_string(measure)));
    }
    EXPECT_EQ(parsed(abridged(text, {States::all, Keys::none})), shorter);
  }
}

TEST(Abridged, IsReadOnlyIfItsChecksumIsRight) {
  const test::TemporaryDirectory directory;
  std::filesystem::create_directories(directory / "records");
  for (const auto& record : unusual_records()) {
    const auto text = sealed(record);
    const auto name = replicate_name(test::make_plan(parse_manifest(test::good_manifest().dump(), "m")).front());
    const auto file = directory / "records" / (name + ".json");
    test::write_text(file, text);
    expect_same(read_record(directory.path(), name, Abridgement{}), read_record(directory.path(), name));
    for (std::size_t at = 0; at < text.size(); at += 97) {
      auto changed = text;
      changed[at] = static_cast<char>(changed[at] ^ 1);
      test::write_text(file, changed);
      EXPECT_THROW(read_record(directory.path(), name, Abridgement{}), InputError) << at;
      test::write_text(file, text.substr(0, at));
      EXPECT_THROW(read_record(directory.path(), name, Abridgement{States::nearest}), InputError) << at;
    }
  }
}

}  // namespace
}  // namespace isojam
