#include "tasks/measure/quantity.hpp"

#include <gtest/gtest.h>

#include <set>
#include <string>

#include "tasks/measure/measure.hpp"
#include "tasks/measure/rearrangements.hpp"

namespace isojam {
namespace {

TEST(Quantities, AreListedOnce) {
  std::set<std::string_view> names;
  std::set<std::pair<Quantity::Of, std::string_view>> places;
  for (const auto& quantity : all_quantities()) {
    EXPECT_TRUE(names.insert(quantity.name).second) << quantity.name << " is the name of two";
    EXPECT_TRUE(places.insert({quantity.of, quantity.pointer}).second) << quantity.pointer << " is the place of two";
    EXPECT_NO_THROW(Json::json_pointer(std::string(quantity.pointer))) << quantity.name;
    for (const auto text :
         {quantity.name, quantity.pointer, quantity.group.name, quantity.group.meaning, quantity.unit, quantity.latex})
      EXPECT_FALSE(text.empty()) << quantity.name;
  }
}

TEST(Quantities, BelongToTheirMeasures) {
  EXPECT_EQ(all_quantities().front().name, "phi_j");
  EXPECT_FALSE(all_quantities().front().measure);
  EXPECT_FALSE(quantity("phi_0").measure);
  std::size_t told = 2 + rearrangement_quantities().size();
  for (const auto& row : rearrangement_quantities()) EXPECT_FALSE(quantity(row.name).measure) << row.name;
  for (const Measure measure : all_measures) {
    for (const auto& row : definition_of(measure).quantities) {
      ++told;
      EXPECT_EQ(quantity(row.name).measure, measure) << row.name;
      EXPECT_EQ(quantity(row.name).pointer, row.pointer);
    }
  }
  EXPECT_EQ(told, all_quantities().size());
  EXPECT_FALSE(quantity_index("phi_K"));
}

TEST(Quantities, GroupsAreContiguous) {
  std::vector<std::string_view> groups;
  for (const auto& quantity : all_quantities()) {
    if (groups.empty() || groups.back() != quantity.group.name) groups.push_back(quantity.group.name);
  }
  EXPECT_EQ(groups.front(), main_group.name);
  EXPECT_EQ(std::set(groups.begin(), groups.end()).size(), groups.size()) << ::testing::PrintToString(groups);
}

TEST(Quantities, AreWrittenToTheirPlace) {
  for (const auto& quantity : all_quantities()) {
    const Json::json_pointer pointer{std::string(quantity.pointer)};
    Json record;
    put(record, quantity, 2.5);
    EXPECT_EQ(record.at(pointer), 2.5) << record;
    put(record, quantity, 3);
    EXPECT_EQ(record.at(pointer).dump(), "3");
    put(record, quantity, std::nullopt, "none");
    EXPECT_TRUE(record.at(pointer).is_null());
    EXPECT_EQ(record.at(Json::json_pointer(std::string(quantity.pointer) + "_reason")), "none");
  }
}

}  // namespace
}  // namespace isojam
