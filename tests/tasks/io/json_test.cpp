#include "tasks/io/json.hpp"
#include "tasks/io/parse.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <limits>
#include <locale>

#include "engine/random/stream.hpp"
#include "tasks/io/input_error.hpp"
#include "tasks/io/place.hpp"

namespace isojam {
namespace {

double any_finite_double(RandomStream& random) {
  for (;;) {
    const double x = std::bit_cast<double>(random.bits());
    if (std::isfinite(x)) return x;
  }
}

TEST(JsonText, DoublesAreReadAsWritten) {
  RandomStream random{1, 2};
  for (int i = 0; i < 20000; ++i) {
    const double x = i % 2 ? any_finite_double(random) : random.normal();
    const auto text = pretty(Json{{"x", x}});
    const double y = parse_json(text, "x").at("x").get<double>();
    ASSERT_EQ(std::bit_cast<std::uint64_t>(x), std::bit_cast<std::uint64_t>(y)) << text;
  }
}

TEST(JsonText, PrettyTextParsesToTheSame) {
  const auto value =
      Json::parse(R"({"b":[],"a":{},"list":[1,2.5,"x",null,true],"rows":[[1,2],[3,4]],"o":{"p":{"q":[{}]}}})");
  const auto text = pretty(value);
  EXPECT_EQ(parse_json(text, "text").dump(), value.dump()) << text;
  EXPECT_NE(text.find("\n  \"list\": [1, 2.5, \"x\", null, true],\n"), std::string::npos) << text;
}

TEST(JsonText, NumbersBeyondJsonBecomeNullWithAReason) {
  Json object;
  put_number(object, "finite", 1.5);
  put_number(object, "large", std::numeric_limits<double>::infinity());
  put_number(object, "none", std::nan(""));
  EXPECT_EQ(object.dump(),
            R"({"finite":1.5,"large":null,"large_reason":"infinite","none":null,"none_reason":"not a number"})");
}

struct CommaPoint : std::numpunct<char> {
  char do_decimal_point() const override { return ','; }
  char do_thousands_sep() const override { return '.'; }
  std::string do_grouping() const override { return "\3"; }
};

TEST(JsonText, LocaleChangesNothing) {
  const auto write = [] { return pretty(Json{{"x", 1234567.25}, {"n", 1234567}}) + number_in({0.5, 1e6}); };
  const auto before = write();
  const auto previous = std::locale::global(std::locale(std::locale::classic(), new CommaPoint));
  const auto after = write();
  const double read = parse_json(R"({"x": 1.5})", "x").at("x").get<double>();
  std::locale::global(previous);
  EXPECT_EQ(before, after);
  EXPECT_EQ(read, 1.5);
}

TEST(JsonText, OnlyCompleteTextsAreAccepted) {
  const std::string text = R"({"name": "a", "list": [1, -2.5e3, {"x": null}], "y": true})";
  EXPECT_NO_THROW(parse_json(text, "t"));
  for (std::size_t n = 0; n < text.size(); ++n) EXPECT_THROW(parse_json(text.substr(0, n), "t"), InputError) << n;
}

TEST(JsonText, SyntaxErrorsNameLineAndColumn) {
  for (int line = 1; line <= 5; ++line) {
    for (int column = 2; column <= 8; ++column) {
      // A list of blanks with one wrong character.
      std::string text = "[";
      text.append(line - 1, '\n').append(line == 1 ? column - 2 : column - 1, ' ').append("?]");
      try {
        parse_json(text, "t");
        ADD_FAILURE() << text;
      } catch (const InputError& error) {
        EXPECT_EQ(error.details().file, fmt::format("t:{}:{}", line, column)) << text;
      }
    }
  }
}

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

TEST(JsonPlace, PointersAreEscaped) {
  const auto document = Json::parse(R"({"a/b": {"c~d": [1, "x"]}})");
  const auto place = JsonPlace(document, "f").at("a/b").at("c~d").at(1);
  EXPECT_EQ(place.pointer(), "/a~1b/c~0d/1");
  EXPECT_EQ(document.at(Json::json_pointer(place.pointer())), place.value());
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
