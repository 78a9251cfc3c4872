#include "engine/names/enum_names.hpp"

#include <gtest/gtest.h>

#include <set>

namespace isojam {

enum class Phase { liquid = 3, jammed = 1 };
template <>
inline constexpr std::array enum_names<Phase>{EnumName{Phase::liquid, "liquid"}, EnumName{Phase::jammed, "jammed"}};
enum class Nameless { one };

namespace {

static_assert(NamedEnum<Phase> && !NamedEnum<Nameless> && !NamedEnum<int>);
static_assert(to_string(Phase::jammed) == "jammed" && from_string<Phase>("liquid") == Phase::liquid);
static_assert(all_of<Phase> == std::array{Phase::liquid, Phase::jammed});

TEST(EnumNames, NamesAndEnumeratorsAreFound) {
  for (const Phase phase : all_of<Phase>) EXPECT_EQ(from_string<Phase>(to_string(phase)), phase);
  for (const auto* other : {"", "Liquid", "liquid ", "jamme"}) EXPECT_FALSE(from_string<Phase>(other)) << other;
  const std::set<std::string_view> names(all_names<Phase>.begin(), all_names<Phase>.end());
  EXPECT_EQ(names, (std::set<std::string_view>{"jammed", "liquid"}));
}

}  // namespace
}  // namespace isojam
