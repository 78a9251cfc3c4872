// Ten thousand manifests, made from valid ones by changes of a few places or bytes with fixed seeds.

#include <gtest/gtest.h>

#include <random>
#include <set>

#include "tasks/io/input_error.hpp"
#include "tasks/records/summary.hpp"
#include "tasks/tables/aggregate.hpp"
#include "tasks/tables/tables.hpp"
#include "tests/tasks/support/bad_manifests.hpp"
#include "tests/tasks/support/support.hpp"

namespace isojam {
namespace {

using Random = std::mt19937_64;

/// All places of a document, including inner ones.
std::vector<Json::json_pointer> places_of(const Json& document) {
  std::vector<Json::json_pointer> places;
  const auto flat = document.flatten();
  for (const auto& item : flat.items()) {
    for (Json::json_pointer place(item.key()); !place.empty(); place = place.parent_pointer()) places.push_back(place);
  }
  return places;
}

Json odd_value(Random& random) {
  static const std::vector<Json> values{nullptr,
                                        true,
                                        false,
                                        0,
                                        -1,
                                        1,
                                        2,
                                        1e308,
                                        -1e308,
                                        1e-320,
                                        0.5,
                                        1000000007,
                                        "",
                                        "octahedron",
                                        "phi_j",
                                        "../..",
                                        "\xe2\x82\xac",
                                        Json::array(),
                                        Json::object(),
                                        Json{1, 2, 3},
                                        Json{{"min", 2}},
                                        Json{Json{Json{1}}},
                                        18446744073709551615ULL};
  return values[random() % values.size()];
}

/// Makes one to three changes: replaces a value by an unusual one or by a value from another place, or removes or adds
/// a key.
Json changed(Json document, Random& random) {
  for (auto changes = 1 + random() % 3; changes > 0 && document.is_structured() && !document.empty(); --changes) {
    const auto places = places_of(document);
    if (places.empty()) break;
    const auto& place = places[random() % places.size()];
    auto& parent = document[place.parent_pointer()];
    switch (random() % 4) {
      case 0: document[place] = odd_value(random); break;
      case 1: document[place] = Json(document[places[random() % places.size()]]); break;
      case 2:
        if (parent.is_object()) parent.erase(place.back());
        break;
      default:
        if (parent.is_object()) parent["key" + std::to_string(random() % 3)] = odd_value(random);
    }
  }
  return document;
}

std::string changed_text(std::string text, Random& random) {
  for (auto changes = 1 + random() % 4; changes > 0 && !text.empty(); --changes) {
    const auto at = random() % text.size();
    switch (random() % 4) {
      case 0: text[at] = static_cast<char>(random()); break;
      case 1: text.erase(at, 1 + random() % 8); break;
      case 2: text.insert(at, 1, "{}[],:\"0-.eE\\u"[random() % 15]); break;
      default: text.insert(at, text.substr(random() % text.size(), random() % 20));
    }
  }
  return text;
}

/// Checks a manifest. Returns true if it was accepted.
bool refused_or_sound(const std::string& text) {
  try {
    const auto manifest = parse_manifest(text, "m.json");
    const auto canonical = to_json(manifest);
    EXPECT_EQ(to_json(parse_manifest(canonical.dump(), "canonical")), canonical) << text;
    const Plan plan(manifest);
    std::set<std::string> names;
    for (std::size_t i = 0; i < plan.size() && i < 50; ++i) names.insert(replicate_name(plan[i]));
    EXPECT_EQ(names.size(), std::min<std::size_t>(plan.size(), 50)) << text;
    for (const auto& name : names) EXPECT_EQ(name.find_first_of("/\\"), std::string::npos) << name;
    return true;
  } catch (const InputError& error) {
    std::set<std::string> pointers;
    for (const auto& each : error.all()) {
      EXPECT_EQ(one_line(each).rfind("m.json", 0), 0U) << error.what() << "\n" << text;
      EXPECT_TRUE(pointers.insert(each.pointer).second) << "two errors at " << each.pointer << ": " << text;
    }
    return false;
  }
}

Json rich_manifest() {
  auto manifest = test::tiny_manifest();
  manifest["sweep"]["target_energy"] = {1e-6, 1e-5};
  manifest["protocol"].erase("target_energy");
  manifest["replicates"] = {{"min", 4}, {"max", 40}, {"quantity", "Z"}, {"half_width", 0.1}};
  manifest["keep_path"] = true;
  manifest["exclude"] = {"crystalline", "not_stable"};
  manifest["base"] = {{"target_energy", 1e-5}};
  return manifest;
}

TEST(Mutation, ManifestsAreRejectedOrValid) {
  Random random(17);
  int accepted = 0;
  for (int trial = 0; trial < 5000; ++trial) {
    const auto good = trial % 2 ? rich_manifest() : test::good_manifest();
    accepted += refused_or_sound(changed(good, random).dump(-1, ' ', true, Json::error_handler_t::replace));
    accepted += refused_or_sound(changed_text(good.dump(), random));
  }
  std::printf("%d of 10000 changed manifests were still valid\n", accepted);
  EXPECT_GT(accepted, 100) << "changes that always break prove little";
  EXPECT_LT(accepted, 9000);
}

TEST(Mutation, RecordsAreRejectedOrTabulated) {
  Random random(19);
  const auto spec = test::make_plan(parse_manifest(test::good_manifest().dump(), "m")).front();
  const auto record = test::record_on_disk(test::made_up_outcome(spec));
  int accepted = 0;
  for (int trial = 0; trial < 2000; ++trial) {
    const auto document = changed(record, random);
    try {
      const auto summary = summarise_record(document, "r.json");
      to_json(aggregate(std::span(&summary, 1))).dump();
      ++accepted;
    } catch (const InputError& error) {
      EXPECT_EQ(std::string(error.what()).rfind("r.json", 0), 0U) << error.what();
    }
  }
  std::printf("%d of 2000 changed records still made a table\n", accepted);
  EXPECT_GT(accepted, 100);
  EXPECT_LT(accepted, 1900);
}

}  // namespace
}  // namespace isojam
