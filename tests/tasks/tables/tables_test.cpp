// Properties tested here:
// - The text table is aligned, shows two significant digits of each half width, and shows the number of replicates if
//   fewer have a value. Without a half width, it shows none.
// - A half width is rounded to the sixth digit of the mean, and is never rounded to 0. Values that are all equal are
//   marked. Proportions have both ends of their interval.
// - Integers without spread are printed as integers.
// - Other groups of columns have their own tables if they were measured. Small numbers have a common power of ten.
// - In CSV and LaTeX, every row has as many cells as the heading. CSV has the numbers of tables.json.
// - No two columns have the same name, whatever was swept.
// - Characters with a special meaning in CSV, in LaTeX or on a terminal are escaped, whatever texts a record contains.

#include "tasks/tables/tables.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <set>

#include "tasks/tables/estimate_text.hpp"

namespace isojam {
namespace {

Row row(SolidKind solid, int particles, const std::vector<double>& values) {
  Row row;
  row.solid = solid;
  row.particles = particles;
  row.parameters = Json{{"target_energy", 1e-5}};
  row.replicates = static_cast<int>(values.size());
  for (std::size_t i = 0; i < all_quantities().size(); ++i) {
    if (all_quantities()[i].group == main_group) row.estimates[i] = estimate(values, i);
  }
  row.residual = 1.25e-7;
  return row;
}

Table table() {
  Table table;
  table.rows.push_back(row(SolidKind::octahedron, 64, {0.6812, 0.6844, 0.6789, 0.6803}));
  table.rows.push_back(row(SolidKind::dodecahedron, 1000, {11.5}));
  table.rows.push_back(row(SolidKind::cube, 8, {}));
  table.rows[0].estimates[2] = estimate({9.0, 10.5}, 1);
  table.rows[2].replicates = table.rows[2].failed = 3;
  table.rows[2].residual.reset();
  return table;
}

std::vector<std::string> split(const std::string& text, const std::string& separator) {
  std::vector<std::string> parts;
  std::size_t at = 0;
  for (auto next = text.find(separator); next != std::string::npos; next = text.find(separator, at)) {
    parts.push_back(text.substr(at, next - at));
    at = next + separator.size();
  }
  parts.push_back(text.substr(at));
  return parts;
}

std::size_t characters(const std::string& text) {
  std::size_t n = 0;
  for (const char c : text) n += (c & 0xC0) != 0x80;
  return n;
}

TEST(Tables, TextIsAlignedAndRounded) {
  const auto lines = split(to_text(table()), "\n");
  ASSERT_EQ(lines.size(), 5U);
  for (int i = 1; i < 4; ++i) EXPECT_EQ(characters(lines[i]), characters(lines[0])) << lines[i];
  EXPECT_EQ(lines[0].rfind("solid", 0), 0U);
  // Mean .6812, sd .002332, t 3.182 and n 4 give the half width .00371.
  EXPECT_NE(lines[1].find(" 0.6812 ± 0.0037 "), std::string::npos) << lines[1];
  EXPECT_NE(lines[1].find(" 9.8 ± 9.5 (2) "), std::string::npos) << lines[1];
  EXPECT_NE(lines[1].find(" 1.2e-07"), std::string::npos) << lines[1];
  EXPECT_NE(lines[2].find(" 11.5000 "), std::string::npos) << lines[2];
  EXPECT_EQ(lines[2].find("±"), std::string::npos) << lines[2];
  EXPECT_NE(lines[3].find(" 3 "), std::string::npos) << lines[3];
}

TEST(Tables, CsvHasTheNumbersOfTheJson) {
  const auto lines = split(to_csv(table()), "\n");
  const auto head = split(lines[0], ",");
  const auto json = to_json(table());
  for (std::size_t r = 0; r < 3; ++r) {
    const auto cells = split(lines[r + 1], ",");
    ASSERT_EQ(cells.size(), head.size()) << lines[r + 1];
    for (std::size_t i = 0; i < head.size(); ++i) {
      const auto end = head[i].rfind("_mean");
      if (end == std::string::npos) continue;
      if (!json.at("rows").at(r).contains(head[i].substr(0, end))) {
        EXPECT_EQ(cells[i], "") << head[i] << " was not measured";
        continue;
      }
      const auto& mean = json.at("rows").at(r).at(head[i].substr(0, end)).at("mean");
      if (mean.is_null()) {
        EXPECT_EQ(cells[i], "");
      } else {
        EXPECT_EQ(std::strtod(cells[i].c_str(), nullptr), mean.get<double>()) << head[i];
      }
    }
  }
}

TEST(Tables, LatexRowsHaveTheSameNumberOfCells) {
  const auto text = to_latex(table());
  std::size_t rows = 0, cells = 0;
  for (const auto& line : split(text, "\n")) {
    if (line.find(" & ") == std::string::npos) continue;
    if (rows++ == 0) cells = split(line, " & ").size();
    EXPECT_EQ(split(line, " & ").size(), cells) << line;
  }
  EXPECT_EQ(rows, 4U);
  EXPECT_NE(text.find("target\\_energy"), std::string::npos);
  EXPECT_NE(text.find("{l" + std::string(cells - 1, 'r') + "}"), std::string::npos) << text;
}

/// A table with a swept parameter whose name can only come from a record made by hand.
Table hostile_table() {
  auto hostile = table();
  for (auto& row : hostile.rows)
    row.parameters = Json{{"a \"b\", c", "one, \"two\"\nthree"}, {"#$%&_{}~^\\", "50 % & ~\x1B[2J"}};
  return hostile;
}

TEST(Tables, CsvFieldsAreQuotedIfNecessary) {
  for (const auto& text : {to_csv(hostile_table()), to_long_csv(hostile_table())}) {
    EXPECT_NE(text.find(",\"a \"\"b\"\", c\","), std::string::npos) << text.substr(0, 300);
    EXPECT_NE(text.find(",\"one, \"\"two\"\"\nthree\","), std::string::npos) << text.substr(0, 1000);
    EXPECT_NE(text.find(",#$%&_{}~^\\,"), std::string::npos) << text.substr(0, 300);
    EXPECT_NE(text.find("\noctahedron,64,"), std::string::npos) << "nothing else is quoted";
  }
}

TEST(Tables, LatexEscapesEverySpecialCharacter) {
  const auto text = to_latex(hostile_table());
  EXPECT_NE(text.find("& \\#\\$\\%\\&\\_\\{\\}\\textasciitilde{}\\textasciicircum{}\\textbackslash{} &"),
            std::string::npos)
      << text;
  EXPECT_NE(text.find("& 50 \\% \\& \\textasciitilde{}?[2J &"), std::string::npos) << text;
  EXPECT_NE(text.find("& one, \"two\"?three &"), std::string::npos) << text;
}

TEST(Tables, TextContainsNoControlCharacters) {
  const auto text = to_text(hostile_table());
  EXPECT_NE(text.find(" one, \"two\"?three "), std::string::npos) << text;
  EXPECT_EQ(text.find('\x1B'), std::string::npos) << text;
  EXPECT_EQ(split(text, "\n").size(), split(to_text(table()), "\n").size()) << text;
}

TEST(Tables, NoTwoColumnsHaveOneName) {
  auto swept = table();
  for (auto& row : swept.rows) row.parameters = Json{{"residual", 1e-6}, {"target_energy", 1e-5}};
  for (const auto view : {View::nearest, View::series}) {
    for (const auto& text : {to_csv(swept, view), to_long_csv(swept, view)}) {
      const auto head = split(split(text, "\n")[0], ",");
      EXPECT_EQ(std::set(head.begin(), head.end()).size(), head.size()) << text.substr(0, 200);
      EXPECT_NE(std::find(head.begin(), head.end(), "minimiser.residual"), head.end()) << text.substr(0, 200);
      EXPECT_NE(std::find(head.begin(), head.end(), "target_energy"), head.end()) << text.substr(0, 200);
    }
  }
  EXPECT_EQ(to_text(swept).rfind("solid             N   minimiser.residual   target_energy", 0), 0U) << to_text(swept);
  EXPECT_NE(to_latex(swept).find("& minimiser.residual & target\\_energy &"), std::string::npos) << to_latex(swept);
}

TEST(Tables, OtherGroupsFollowIfTheyWereMeasured) {
  auto measured = table();
  const auto q6 = quantity_index("Q6").value();
  EXPECT_EQ(to_text(measured).find("Q6"), std::string::npos);
  measured.rows[1].estimates[q6] = estimate({2.5e-7, 3.5e-7}, 1);
  const auto text = to_text(measured);
  EXPECT_NE(text.find("\norder\n"), std::string::npos) << text;
  // Mean 3e-7, sd 7.07e-8, t 12.71 and n 2 give the half width 6.35e-7.
  EXPECT_NE(text.find("(3.00 ± 6.35)e-07"), std::string::npos) << text;
  EXPECT_EQ(text.find("clusters"), std::string::npos) << text;
  EXPECT_TRUE(to_json(measured).at("rows").at(1).contains("Q6"));
  EXPECT_FALSE(to_json(measured).at("rows").at(0).contains("Q6"));
}

TEST(Tables, ExactCountsAreWholeNumbersAndOneSmallNumberHasNoBrackets) {
  const auto text_of = [](const std::vector<double>& values) {
    auto measured = table();
    measured.rows = {row(SolidKind::cube, 8, {})};
    measured.rows[0].replicates = static_cast<int>(values.size());
    measured.rows[0].estimates[0] = estimate(values, 1);
    // The only cell with a value ends at the end of its heading.
    const auto lines = split(to_text(measured), "\n");
    const auto wide = lines[1].size() - characters(lines[1]);
    return split(lines[1].substr(0, lines[0].find("phi_j") + 5 + wide), "   ").back();
  };
  const std::vector<std::pair<std::vector<double>, std::string>> cases{{{3, 3, 3}, "3"},
                                                                       {{3}, "3"},
                                                                       {{0, 0}, "0"},
                                                                       {{-2, -2}, "-2"},
                                                                       {{0.5, 0.5}, "0.5000 (equal)"},
                                                                       {{2.25}, "2.2500"},
                                                                       {{7.93e-5}, "7.93e-05"},
                                                                       {{7.93e-5, 7.93e-5}, "7.93e-05 (equal)"},
                                                                       {{-4e-7}, "-4.00e-07"}};
  for (const auto& [values, expected] : cases) {
    const auto text = text_of(values);
    EXPECT_EQ(text.substr(std::min(text.size(), text.find_first_not_of(' '))), expected);
  }
}

TEST(Tables, HalfWidthsAreRoundedToADigitOfTheMean) {
  const auto text_of = [](double mean, double half) {
    Estimate estimate;
    estimate.n = 4;
    estimate.mean = mean;
    estimate.half_width = half;
    return estimate_text(estimate, Format::text, 4);
  };
  EXPECT_EQ(text_of(0.0399999984, 6.6e-9), "0.0400000 ± 0.0000001");
  EXPECT_EQ(text_of(0.68123456, 4.2e-6), "0.681235 ± 0.000004");
  EXPECT_EQ(text_of(0.68123456, 4.2e-5), "0.681235 ± 0.000042");
  EXPECT_EQ(text_of(12345678, 0.5), "12345678 ± 1");
  EXPECT_EQ(text_of(0, 6.6e-9), "0.0000000000 ± 0.0000000066");
  EXPECT_EQ(text_of(8.57e-4, 1e-9), "(8.57 ± 0.01)e-04");
}

TEST(Tables, ProportionsHaveBothEndsOfWilsonsInterval) {
  EXPECT_EQ(estimate_text(proportion_estimate({1, 0, 0, 0, 0, 0}), Format::text, 6), "0.17 [0.03, 0.56]");
  EXPECT_EQ(estimate_text(proportion_estimate({1, 1, 1, 1}), Format::latex, 6), "1.00 [0.51, 1.00] (4)");
  EXPECT_EQ(estimate_text(proportion_estimate({1}), Format::text, 1), "1");
  auto measured = table();
  measured.rows[0].estimates[*quantity_index("percolates")] = proportion_estimate({0, 0, 1, 0});
  const auto json = to_json(measured).at("rows").at(0);
  EXPECT_EQ(json.at("percolates").at("interval"), "wilson");
  EXPECT_GT(json.at("percolates").at("ci95").at(0), 0);
  EXPECT_FALSE(json.at("phi_j").contains("interval"));
}

TEST(Tables, JsonStatesWhyThereIsNoInterval) {
  const auto rows = to_json(table()).at("rows");
  EXPECT_FALSE(rows.at(0).at("phi_j").contains("reason"));
  EXPECT_TRUE(rows.at(1).at("phi_j").at("ci95").is_null());
  EXPECT_EQ(rows.at(1).at("phi_j").at("reason"), "one replicate has no spread");
  EXPECT_TRUE(rows.at(2).at("phi_j").at("mean").is_null());
  EXPECT_EQ(rows.at(2).at("phi_j").at("reason"), "no replicate that counts has this value");
}

}  // namespace
}  // namespace isojam
