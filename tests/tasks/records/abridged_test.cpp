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

Outcome made_up() {
  return test::made_up_outcome(test::make_plan(parse_manifest(test::good_manifest().dump(), "m")).front());
}

std::string table_of(const RecordSummary& summary) {
  return pretty(to_json(aggregate(std::vector<RecordSummary>{summary})));
}

void expect_same(const RecordedReplicate& quick, const RecordedReplicate& whole) {
  EXPECT_EQ(table_of(quick.summary), table_of(whole.summary));
  EXPECT_EQ(quick.summary.result_digest, whole.summary.result_digest);
  EXPECT_EQ(quick.summary.manifest_digest, whole.summary.manifest_digest);
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
  const auto whole = read_record(directory / "r", name), quick = read_abridged_record(directory / "r", name);
  EXPECT_TRUE(whole.record.contains("path"));
  EXPECT_FALSE(quick.record.contains("path")) << "it was not read quickly";
  EXPECT_LT(quick.record.dump().size(), whole.record.dump().size() / 2);
  expect_same(quick, whole);
  const auto bins = Json::json_pointer("/states/0/contacts/angle_bins");
  EXPECT_EQ(quick.record.at(bins), whole.record.at(bins));
  EXPECT_TRUE(quick.summary.angles);
  EXPECT_FALSE(quick.summary.states.empty());
  const auto brief = read_record_without_states(directory / "r", name);
  EXPECT_EQ(brief.summary.values, whole.summary.values);
  EXPECT_TRUE(brief.summary.states.empty());
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

TEST(Abridged, ReadsNumbersLikeAParser) {
  Json document{{"schema", "x"}};
  document["numbers"] = {0,
                         -1,
                         9223372036854775807,
                         -9223372036854775807 - 1,
                         18446744073709551615U,
                         0.1,
                         -0.0,
                         1e-5,
                         1e300,
                         5e-324,
                         0.30000000000000004,
                         true,
                         false,
                         nullptr};
  document["text"] = "plain, with θ_ff";
  document["object"] = {{"empty", Json::object()}, {"list", {1, 2, {{"a", 3}}}}, {"none", Json::array()}};
  document["spec"] = {{"list", {1, 2}}};
  document["path"] = {1, 2, 3};
  const auto text = sealed(document);
  const auto read = abridged(text, States::keep);
  ASSERT_TRUE(read);
  EXPECT_EQ(read->result_digest, result_digest(document));
  auto expected = parse_sealed(text, "document");
  expected.erase("checksum");
  expected.erase("path");
  expected["object"]["list"] = Json::array();
  EXPECT_EQ(read->record, expected);
  EXPECT_EQ(read->record.dump(), expected.dump());
  for (std::size_t k = 0; k < expected["numbers"].size(); ++k)
    EXPECT_EQ(read->record["numbers"][k].type(), expected["numbers"][k].type()) << expected["numbers"][k];
}

TEST(Abridged, RejectsChangedTexts) {
  const auto text = sealed(make_record(made_up()));
  ASSERT_TRUE(abridged(text, States::keep));
  for (std::size_t at = 0; at < text.size(); at += 3) {
    auto changed = text;
    changed[at] = static_cast<char>(changed[at] ^ 1);
    EXPECT_FALSE(abridged(changed, States::keep)) << at;
    EXPECT_FALSE(abridged(text.substr(0, at), States::keep)) << at;
  }
  EXPECT_FALSE(abridged(text + "x", States::keep));
}

TEST(Abridged, LeavesUnusualTextsToTheParser) {
  auto nested = Json::array();
  for (int k = 0; k < 40; ++k) nested = Json::array({nested});
  for (const auto& [key, value] : {std::pair<std::string, Json>{"a", "\"quoted\""}, {"q\"", 1}, {"a", nested}}) {
    Json document{{"schema", "x"}};
    document[key] = value;
    EXPECT_FALSE(abridged(sealed(document), States::keep)) << document;
  }
  const test::TemporaryDirectory directory;
  auto outcome = made_up();
  outcome.failure = Failure{"jam", "the word \"density\" φ"};
  const auto name = replicate_name(outcome.spec);
  std::filesystem::create_directories(directory / "records");
  test::write_text(directory / "records" / (name + ".json"), sealed(make_record(outcome)));
  expect_same(read_abridged_record(directory.path(), name), read_record(directory.path(), name));
  test::write_text(directory / "records" / (name + ".json"), "{");
  EXPECT_THROW(read_abridged_record(directory.path(), name), InputError);
}

}  // namespace
}  // namespace isojam
