#include "tasks/io/json.hpp"
#include "tasks/io/parse.hpp"

#include <gtest/gtest.h>

#include "tasks/io/input_error.hpp"
#include "tasks/io/place.hpp"

namespace isojam {
namespace {

TEST(JsonText, SyntaxErrorsStateTheRemedy) {
  for (const auto& [text, says] : std::vector<std::pair<std::string, std::string>>{
           {R"({"a": 1,})", "t:1:9: /a: not valid JSON: comma before '}'; remove the comma"},
           {R"({"a": 1 "b": 2})", "t:1:11: /a: not valid JSON: ',' or '}' is missing before this place; add it"},
           {"[1,\n ]", "t:2:2: /0: not valid JSON: comma before ']'; remove the comma"},
           {R"({"a": NaN})",
            "t:1:7: /a: not valid JSON: \"NaN\" is not a value; write a number, true, false, null, or "
            "a text in double quotes"},
           {R"({'a': 1})",
            "t:1:2: not valid JSON: \"'a'\" is not a value; write a number, true, false, null, or a text "
            "in double quotes"},
           {R"({"a": [1)", "t:1:9: /a/0: not valid JSON: the text ends, but a ']' is missing; add it"},
           {R"({"a": 1)", "t:1:8: /a: not valid JSON: the text ends, but a '}' is missing; add it"},
           {R"({"a": 1} x)",
            "t:1:10: not valid JSON: the document ends before this place; remove the text after its "
            "end"},
           {"{\"a\": \"\xff\"}", "t:1:8: /a: the text is not valid UTF-8; save the file in UTF-8"}}) {
    try {
      parse_json(text, "t");
      ADD_FAILURE() << text;
    } catch (const InputError& error) {
      EXPECT_EQ(std::string(error.what()), says) << text;
    }
  }
}

TEST(JsonPlace, SuggestsTheNearestNameOrNone) {
  constexpr std::array<std::string_view, 3> names{"octahedron", "dodecahedron", "cube"};
  EXPECT_EQ(nearest_name("octahedra", names), "octahedron");
  EXPECT_EQ(nearest_name("Dodecahedron", names), "dodecahedron");
  EXPECT_EQ(nearest_name("cubes", names), "cube");
  EXPECT_EQ(nearest_name("sphere", names), "");
  EXPECT_EQ(nearest_name("", names), "");
  constexpr std::array<std::string_view, 3> flags{"crystalline", "not_balanced", "not_stable"};
  EXPECT_EQ(nearest_name("crystal", flags), "crystalline");
  EXPECT_EQ(nearest_name("cr", flags), "");
  EXPECT_EQ(nearest_name("not_", flags), "") << "two names begin with it";
}

}  // namespace
}  // namespace isojam
