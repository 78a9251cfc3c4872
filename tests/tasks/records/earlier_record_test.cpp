// Properties tested here for records of version 3:
// - With their keys moved, they are the same as records of version 4, also for failed replicates.
// - They are read from a directory like those of version 4, with the digest that their packings state.
// - No measure can be added to them, and the message states what to do.

#include <gtest/gtest.h>

#include <algorithm>

#include "tasks/io/input_error.hpp"
#include "tasks/io/sealed.hpp"
#include "tasks/records/earlier_record.hpp"
#include "tasks/records/record.hpp"
#include "tasks/records/recorded.hpp"
#include "tasks/records/store.hpp"
#include "tasks/run/additions.hpp"
#include "tests/tasks/support/support.hpp"

namespace isojam {
namespace {

Json earlier_state(const Json& state) {
  Json earlier = Json::object();
  for (const auto& item : state.items()) {
    if (item.key() == "contacts") {
      earlier.update(item.value());
    } else {
      earlier[item.key()] = item.value();
    }
  }
  return earlier;
}

/// A record of version 4 in the format of version 3.
Json earlier_of(const Json& record) {
  Json earlier = Json::object();
  for (const auto& item : record.items()) {
    std::string key = item.key();
    Json value = item.value();
    for (const auto& [measure, before] : {std::pair<std::string, std::string>{"modes", "mode_scaling"},
                                          {"moduli", "moduli_scaling"},
                                          {"strict", "freed"}}) {
      if (key.starts_with(measure)) key = before + key.substr(measure.size());
      if (key == before && value.is_object()) value = Json(value.front());
    }
    earlier[key] = std::move(value);
  }
  earlier["schema"] = earlier_record_schema;
  if (earlier["nearest"].is_object()) earlier["nearest"] = earlier_state(earlier["nearest"]);
  for (Json& state : earlier["states"]) state = earlier_state(state);
  earlier.erase("result_digest");
  earlier["result_digest"] = result_digest(earlier);
  return earlier;
}

Manifest manifest_measuring(const Json& measures) {
  auto json = test::tiny_manifest();
  json["keep_path"] = true;
  json["measure"] = measures;
  return parse_manifest(json.dump(), "m.json");
}

const Manifest& manifest() {
  static const auto made = manifest_measuring({"contacts", "order", "modes", "moduli", "strict"});
  return made;
}

Outcome outcome_with_all_moved_keys() {
  auto outcome = test::made_up_outcome(test::make_plan(manifest()).front());
  outcome.measured.erase(Measure::clusters);
  for (const auto& [what, key] :
       {std::pair{Measure::modes, "scaling"}, {Measure::moduli, "scaling"}, {Measure::strict, "freed"}}) {
    outcome.measured[what].states.assign(outcome.jam.states.size(),
                                         Json{{std::string(to_string(what)), {{"zero", 3}}}});
    outcome.measured[what].replicate[std::string(to_string(what))] = Json{{key, {{"exponent", 2.5}}}};
  }
  for (Json& state : outcome.measured[Measure::order].states) state = Json{{"order", {{"Q6", 0.1}}}};
  return outcome;
}

void expect_same_but_digest(const Json& upgraded, Json record) {
  record["result_digest"] = upgraded.at("result_digest");
  EXPECT_EQ(upgraded.dump(), record.dump());
}

TEST(EarlierRecord, HasTheKeysOfThisVersion) {
  auto outcome = outcome_with_all_moved_keys();
  const auto record = test::record_on_disk(outcome);
  EXPECT_NE(earlier_of(record).at("states").at(0).count("Z"), 0U);
  EXPECT_NE(earlier_of(record).count("freed"), 0U);
  expect_same_but_digest(upgraded_record(earlier_of(record)), record);
  EXPECT_EQ(upgraded_record(record).dump(), record.dump()) << "a record of this version stays as it is";
  outcome.failure = Failure{"modes", "made up"};
  const auto failed = test::record_on_disk(outcome);
  expect_same_but_digest(upgraded_record(earlier_of(failed)), failed);
}

TEST(EarlierRecord, IsReadFromADirectoryAndNotAddedTo) {
  const test::TemporaryDirectory here;
  const auto few = manifest_measuring({"contacts", "order"});
  const Store store(here.path(), few, test::unheard);
  auto outcome = test::made_up_outcome(test::make_plan(few).front());
  outcome.measured.erase(Measure::clusters);
  store.write(outcome);
  const auto file = store.record_path(outcome.spec);
  auto earlier = earlier_of(read_sealed(file.string()));
  earlier.erase("checksum");
  test::write_text(file, sealed(earlier));

  const auto name = replicate_name(outcome.spec);
  const auto held = read_record(here.path(), name);
  EXPECT_TRUE(held.is_earlier);
  EXPECT_EQ(held.summary.result_digest, earlier.at("result_digest").get<std::string>());
  EXPECT_EQ(held.record.at("schema"), record_schema);
  EXPECT_FALSE(held.record.at("states").at(0).at("contacts").empty());

  const auto more = manifest_measuring({"contacts", "order", "clusters"});
  const auto found = additions(here.path(), Plan(more), {name});
  ASSERT_EQ(found.impossible.size(), 1U);
  EXPECT_NE(found.impossible[0].why.find("earlier version"), std::string::npos) << found.impossible[0].why;
}

}  // namespace
}  // namespace isojam
