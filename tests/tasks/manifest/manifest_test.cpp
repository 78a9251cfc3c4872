#include "tasks/manifest/manifest.hpp"
#include "tasks/manifest/plan.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <functional>

#include "tasks/io/input_error.hpp"
#include "tests/tasks/support/bad_manifests.hpp"

namespace isojam {
namespace {

using test::good_manifest;

Manifest parse(const Json& manifest) { return parse_manifest(manifest.dump(), "m.json"); }

/// A value other than the default.
Json another_value(const Parameter& parameter) {
  const auto usual = written(parameter.field);
  if (usual.is_boolean()) return !usual.get<bool>();
  if (const auto* const choice = std::get_if<Choice>(&parameter.field.member)) return choice->names.back();
  return usual.is_number_integer() ? Json(usual.get<long>() + 1) : Json(usual.get<double>() / 2 + 1e-9);
}

/// Calls `work` with each number that has a range, also inside objects and lists.
void for_each_range(const Fields& fields, const std::function<void(const FieldEntry&)>& work) {
  for (FieldEntry field : fields.list) {
    while (std::holds_alternative<Maybe>(field.member) || std::holds_alternative<Many>(field.member)) {
      const MemberRef outer = field.member;
      const auto* const maybe = std::get_if<Maybe>(&outer);
      field.member = maybe ? maybe->example() : std::get<Many>(outer).example();
    }
    if (const auto* const object = std::get_if<Nested>(&field.member)) {
      Fields below;
      object->describe(below);
      for_each_range(below, work);
    }
    const bool number = std::holds_alternative<double*>(field.member) || std::holds_alternative<Integer>(field.member);
    if (number && field.allowed) work(field);
  }
}

bool accepts(const FieldEntry& field, double x) {
  const bool whole = std::holds_alternative<Integer>(field.member);
  const Json value = whole ? Json(static_cast<std::int64_t>(x)) : Json(x);
  try {
    read_into(JsonPlace(value, "m.json"), field);
    return true;
  } catch (const InputError&) {
    return false;
  }
}

TEST(Manifest, RangesIncludeTheirEndsAndNothingBeyond) {
  int checked = 0;
  for_each_range(fields_of<Manifest>(), [&](FieldEntry field) {
    // The references are to objects that others use too.
    double number = 0;
    const bool whole = std::holds_alternative<Integer>(field.member);
    if (whole) std::get<Integer>(field.member).set = [](std::int64_t) {};
    if (!whole) field.member = &number;
    const auto& [low, high, low_excluded, high_excluded] = *field.allowed;
    for (const auto& [end, outwards, excluded] : {std::tuple(low, -1.0, low_excluded), {high, 1.0, high_excluded}}) {
      if (std::abs(end) >= count_range.high) continue;
      const auto beside = [whole](double x, double way) { return whole ? x + way : std::nextafter(x, way * 1e300); };
      EXPECT_EQ(accepts(field, end), !excluded) << field.key << ' ' << end;
      EXPECT_FALSE(accepts(field, beside(end, outwards))) << field.key << " beyond " << end;
      EXPECT_TRUE(accepts(field, beside(end, -outwards))) << field.key << " inside " << end;
      ++checked;
    }
  });
  EXPECT_GT(checked, 60);
}

TEST(Manifest, DefaultsAreThoseOfTheStructs) {
  const auto manifest = parse(good_manifest());
  for (const auto& one : all_parameters())
    EXPECT_EQ(value_of(one.name, manifest.protocol), value_of(one.name, JamOptions{})) << one.name;
  EXPECT_EQ(manifest.measures, (std::vector{Measure::contacts, Measure::order, Measure::clusters}));
}

TEST(Manifest, ParametersAreUniqueAndDefaultsLieInRange) {
  for (const auto& one : all_parameters()) {
    EXPECT_EQ(find_parameter(one.name), &one) << one.name;
    JamOptions options;
    EXPECT_NO_THROW(read_into({written(one.field), "defaults"}, parameter_of(options, one.name).field)) << one.name;
  }
}

TEST(Manifest, EveryParameterCanBeSetAndSwept) {
  for (const auto& one : all_parameters()) {
    const auto& name = one.name;
    const auto value = another_value(one);
    auto fixed = good_manifest();
    fixed[Json::json_pointer(one.pointer)] = value;
    EXPECT_EQ(value_of(name, parse(fixed).protocol), value) << name;

    auto swept = good_manifest();
    swept["sweep"][name] = Json{value, written(one.field)};
    const auto sets = option_sets(parse(swept));
    ASSERT_EQ(sets.size(), 2U) << name;
    for (const auto& set : sets) EXPECT_EQ(value_of(name, set.options), set.parameters.at(name)) << name;
    EXPECT_NE(sets[0].parameters, sets[1].parameters) << name;
  }
}

TEST(Manifest, OrderOfListsAndKeysDoesNotMatter) {
  const auto a = Json::parse(R"({"name":"a","seed":1,"sweep":{"solid":["cube","octahedron"],"particles":[64,80],
    "residual":[1e-5,1e-6],"step_fraction":[0.5,0.2]},"replicates":3})");
  const auto b = Json::parse(R"({"replicates":3,"sweep":{"step_fraction":[0.2,0.5],"residual":[0.000001,1e-5],
    "particles":[80,64],"solid":["octahedron","cube"]},"$schema":"x","seed":1,"name":"a"})");
  EXPECT_EQ(to_json(parse(a)).dump(), to_json(parse(b)).dump());
}

TEST(Manifest, ADigestDependsOnlyOnItsReplicate) {
  const auto first = [](const Json& manifest) { return spec_digest(Plan(parse(manifest)).at(0, 0)); };
  const auto base = first(good_manifest());
  auto other = good_manifest();
  other["name"] = "other";
  other["replicates"] = 1000;
  other["exclude"] = {"not_stable"};
  other["keep_path"] = true;
  other["measure"] = Json::array();
  other["sweep"]["particles"] = {64, 80};
  other["sweep"]["solid"] = {"dodecahedron", "icosahedron"};
  EXPECT_EQ(first(other), base);
  EXPECT_NE(spec_digest(Plan(parse(other)).at(0, 1)), base);
  EXPECT_NE(spec_digest(Plan(parse(other)).at(1, 0)), base);

  std::vector<std::pair<std::string, Json>> changes{
      {"/seed", 8}, {"/sweep/solid", {"cube"}}, {"/sweep/particles", {65}}};
  for (const auto& one : all_parameters()) changes.emplace_back(one.pointer, another_value(one));
  for (const auto& [pointer, value] : changes) {
    auto changed = good_manifest();
    changed[Json::json_pointer(pointer)] = value;
    EXPECT_NE(first(changed), base) << pointer;
  }
}

}  // namespace
}  // namespace isojam
