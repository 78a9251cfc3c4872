#include "tasks/measure/quantity.hpp"

#include <gtest/gtest.h>

#include <set>
#include <string>

#include "tasks/measure/measure.hpp"

namespace isojam {
namespace {

TEST(Quantities, AreListedOnce) {
  std::set<std::string_view> names;
  std::set<std::pair<Quantity::Of, std::string_view>> places;
  for (const auto& quantity : all_quantities()) {
    EXPECT_TRUE(names.insert(quantity.name).second) << quantity.name << " is the name of two";
    EXPECT_TRUE(places.insert({quantity.of, quantity.pointer}).second) << quantity.pointer << " is the place of two";
    EXPECT_NO_THROW(Json::json_pointer(std::string(quantity.pointer))) << quantity.name;
    for (const std::string_view text : {std::string_view(quantity.name), std::string_view(quantity.pointer),
                                        quantity.group.name, quantity.group.meaning, std::string_view(quantity.unit),
                                        std::string_view(quantity.latex), std::string_view(quantity.meaning)})
      EXPECT_FALSE(text.empty()) << quantity.name;
  }
}

TEST(Quantities, BelongToTheirMeasures) {
  EXPECT_EQ(all_quantities().front().name, "phi_j");
  for (const auto* name : {"phi_j", "phi_0", "rearrangements"}) EXPECT_FALSE(quantity(name).measure) << name;
  EXPECT_EQ(quantity("Z_43").pointer, "/contacts/partial/Z_4_3");
  EXPECT_EQ(quantity("Z_43").kinds, 4);
  std::set<Measure> measures;
  for (const auto& row : all_quantities()) {
    if (!row.measure) continue;
    measures.insert(*row.measure);
    EXPECT_EQ(row.pointer.substr(1, row.pointer.find('/', 1) - 1), to_string(*row.measure)) << row.name;
  }
  EXPECT_EQ(measures.size(), all_measures.size());
  EXPECT_FALSE(quantity_index("phi_K"));
}

}  // namespace
}  // namespace isojam
