#include "tasks/manifest/manifest.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <limits>

#include "tasks/io/input_error.hpp"
#include "tasks/manifest/fields.hpp"
#include "tests/tasks/support/bad_manifests.hpp"

namespace isojam {
namespace {

using test::good_manifest;

Manifest parse(const Json& manifest) { return parse_manifest(manifest.dump(), "m.json"); }

bool refused(const Json& manifest) {
  try {
    parse(manifest);
    return false;
  } catch (const InputError&) {
    return true;
  }
}

bool is_integer(const Field& field) {
  JamOptions options;
  const auto slot = field.slot(options);
  return std::holds_alternative<int*>(slot) || std::holds_alternative<long*>(slot);
}

bool is_real(const Field& field) {
  JamOptions options;
  return std::holds_alternative<double*>(field.slot(options));
}

Json number_of(const Field& field, double x) { return is_integer(field) ? Json(std::llround(x)) : Json(x); }

/// A value of the field other than its default.
Json another_value(const Field& field) {
  const auto usual = field_value(field, {});
  if (usual.is_boolean()) return !usual.get<bool>();
  JamOptions options;
  const auto other = std::visit(
      []<class T>(const T*) -> Json {
        if constexpr (std::is_enum_v<T>) return all_names<T>.back();
        return nullptr;
      },
      field.slot(options));
  if (usual.is_string()) return other == usual ? Json("newton") : other;
  return is_integer(field) ? Json(usual.get<long>() + 1) : Json(usual.get<double>() / 2 + 1e-9);
}

TEST(Manifest, RejectsInvalidManifests) {
  for (const auto& bad : test::bad_manifests()) {
    try {
      parse_manifest(bad.text, "m.json");
      ADD_FAILURE() << bad.name << ": accepted " << bad.text.substr(0, 300);
    } catch (const InputError& error) {
      const std::string what = error.what();
      EXPECT_EQ(what.rfind("m.json", 0), 0U) << bad.name << ": " << what;
      EXPECT_NE(what.find(bad.says), std::string::npos) << bad.name << ": " << what;
      EXPECT_TRUE(bad.pointer.empty() || error.details().pointer == bad.pointer) << bad.name << ": " << what;
    }
  }
}

TEST(Manifest, DefaultsAreThoseOfTheStructs) {
  const auto manifest = parse(good_manifest());
  for (const auto& field : all_fields()) {
    EXPECT_EQ(field_value(field, manifest.protocol), field_value(field, JamOptions{})) << field.name;
  }
  EXPECT_EQ(manifest.measures, (std::vector{Measure::contacts, Measure::order, Measure::clusters}));
}

TEST(Manifest, FieldsAreUniqueAndDefaultsLieInRange) {
  for (const auto& field : all_fields()) {
    EXPECT_EQ(find_field(field.name), &field) << field.name;
    const auto usual = field_value(field, {});
    JamOptions options;
    EXPECT_NO_THROW(read_field({usual, "defaults"}, field, options)) << field.name;
  }
}

TEST(Manifest, RangesIncludeTheirEnds) {
  const double infinity = std::numeric_limits<double>::infinity();
  for (const auto& field : all_fields()) {
    if (!is_integer(field) && !is_real(field)) continue;
    const auto& range = field.range;
    const auto beyond = [&](double x, double towards) {
      return number_of(field, is_integer(field) ? x + std::copysign(1, towards) : std::nextafter(x, towards));
    };
    const auto check = [&](const Json& value, bool allowed) {
      JamOptions options;
      bool accepted = true;
      try {
        read_field({value, "m.json", "/x"}, field, options);
      } catch (const InputError&) {
        accepted = false;
      }
      EXPECT_EQ(accepted, allowed) << field.name << " = " << value.dump();
    };
    check(number_of(field, range.low), !range.low_excluded);
    check(number_of(field, range.high), !range.high_excluded);
    check(beyond(range.low, -infinity), false);
    check(beyond(range.high, infinity), false);
    check(beyond(range.low, infinity), true);
    check(beyond(range.high, -infinity), true);
  }
}

TEST(Manifest, EveryFieldCanBeSetAndSwept) {
  for (const auto& field : all_fields()) {
    const std::string name(field.name);
    const auto value = another_value(field);
    auto fixed = good_manifest();
    fixed[Json::json_pointer(pointer_of(field))] = value;
    EXPECT_EQ(field_value(field, parse(fixed).protocol), value) << name;

    auto swept = good_manifest();
    swept["sweep"][name] = Json{value, field_value(field, {})};
    const auto sets = option_sets(parse(swept));
    ASSERT_EQ(sets.size(), 2U) << name;
    for (const auto& set : sets) EXPECT_EQ(field_value(field, set.options), set.parameters.at(name)) << name;
    EXPECT_NE(sets[0].parameters, sets[1].parameters) << name;
  }
}

TEST(Manifest, CanonicalFormIsReadAsTheSameManifest) {
  auto manifest = good_manifest();
  manifest["sweep"]["target_energy"] = {1e-5, 1e-7, 3.2e-5};
  manifest["sweep"]["method"] = {"newton", "lbfgs"};
  const auto once = to_json(parse(manifest));
  EXPECT_EQ(once.dump(), to_json(parse(once)).dump());
  EXPECT_EQ(digest(parse(manifest)), digest(parse(once)));
}

TEST(Manifest, OrderOfListsAndKeysDoesNotMatter) {
  const auto a = Json::parse(R"({"name":"a","seed":1,"sweep":{"solid":["cube","octahedron"],"particles":[64,80],
    "residual":[1e-5,1e-6],"step_fraction":[0.5,0.2]},"replicates":3})");
  const auto b = Json::parse(R"({"replicates":3,"sweep":{"step_fraction":[0.2,0.5],"residual":[0.000001,1e-5],
    "particles":[80,64],"solid":["octahedron","cube"]},"$schema":"x","seed":1,"name":"a"})");
  EXPECT_EQ(to_json(parse(a)).dump(), to_json(parse(b)).dump());
}

TEST(Manifest, DigestChangesWithEveryParameterButReplicates) {
  const auto base = digest(parse(good_manifest()));
  auto more = good_manifest();
  more["replicates"] = 1000;
  more["exclude"] = {"not_stable"};
  EXPECT_EQ(digest(parse(more)), base);
  auto swept = good_manifest();
  swept["sweep"]["step_fraction"] = {0.2, 0.35};
  auto compared = swept;
  compared["base"] = {{"step_fraction", 0.2}};
  EXPECT_EQ(digest(parse(compared)), digest(parse(swept)));

  std::vector<std::pair<std::string, Json>> changes{{"/seed", 8},
                                                    {"/name", "other"},
                                                    {"/sweep/solid", {"cube"}},
                                                    {"/sweep/particles", {65}},
                                                    {"/measure", Json::array()}};
  for (const auto& field : all_fields()) {
    changes.emplace_back(pointer_of(field), another_value(field));
  }
  for (const auto& [pointer, value] : changes) {
    auto changed = good_manifest();
    changed[Json::json_pointer(pointer)] = value;
    EXPECT_NE(digest(parse(changed)), base) << pointer;
  }
}

TEST(Manifest, ExcludesTheGivenOrTheDefaultFlags) {
  EXPECT_EQ(parse(good_manifest()).exclude, (std::vector{Flag::crystalline, Flag::not_balanced}));
  auto manifest = good_manifest();
  manifest["exclude"] = Json::array();
  EXPECT_TRUE(parse(manifest).exclude.empty());
  manifest["exclude"] = {"not_stable", "goal_not_reached", "crystalline"};
  EXPECT_EQ(parse(manifest).exclude, (std::vector{Flag::crystalline, Flag::goal_not_reached, Flag::not_stable}));
  EXPECT_EQ(parse(to_json(parse(manifest))).exclude, parse(manifest).exclude);
}

TEST(Manifest, HasTheGivenBase) {
  EXPECT_EQ(parse(good_manifest()).base, Json::object());
  EXPECT_FALSE(to_json(parse(good_manifest())).contains("base"));
  auto manifest = good_manifest();
  manifest["sweep"]["step_fraction"] = {0.2, 0.35};
  manifest["sweep"]["max_steps"] = {300, 400};
  manifest["sweep"]["method"] = {"newton", "multipliers"};
  manifest["base"] = Json::parse(R"({"step_fraction":3.5e-1,"method":"newton","max_steps":400})");
  const auto parsed = parse(manifest);
  EXPECT_EQ(parsed.base.dump(), R"({"max_steps":400,"method":"newton","step_fraction":0.35})");
  EXPECT_EQ(parse(to_json(parsed)).base.dump(), parsed.base.dump());
  manifest["base"] = Json::parse(R"({"method":"newton"})");
  EXPECT_EQ(parse(manifest).base.dump(), R"({"method":"newton"})");
}

TEST(Manifest, TooFewParticlesNamesTheSmallestValidNumber) {
  for (const auto kind : all_solids) {
    for (const double density : {0.7, 0.9, 1.3}) {
      auto manifest = good_manifest();
      manifest["sweep"]["solid"] = {std::string(to_string(kind))};
      manifest["protocol"]["max_density"] = density;
      manifest["sweep"]["particles"] = {1};
      std::string said;
      try {
        parse(manifest);
      } catch (const InputError& error) {
        said = error.details().remedy;
      }
      int least = 0;
      std::sscanf(said.c_str(), "use at least %d particles", &least);
      ASSERT_GT(least, 1) << to_string(kind) << " at " << density << ": " << said;
      manifest["sweep"]["particles"] = {least - 1};
      EXPECT_TRUE(refused(manifest)) << to_string(kind) << " at " << density << ": " << least;
      manifest["sweep"]["particles"] = {least};
      EXPECT_FALSE(refused(manifest)) << to_string(kind) << " at " << density << ": " << least;
    }
  }
}

}  // namespace
}  // namespace isojam
