#include "tasks/tables/tables.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <set>

#include "tasks/tables/estimate_text.hpp"
#include "tasks/tables/fitted.hpp"

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

/// A table of `rows` rows whose quantities all have values.
Table wide_table(int rows) {
  Table wide;
  for (int k = 0; k < rows; ++k) {
    wide.rows.push_back(row(SolidKind::octahedron, 64 + k, {0.6812, 0.6844, 0.6789, 0.6803 + k * 1e-3}));
    for (std::size_t i = 0; i < all_quantities().size(); ++i)
      wide.rows.back().estimates[i] = wide.rows.back().estimates[0];
  }
  return wide;
}

std::size_t widest(const std::string& text) {
  std::size_t most = 0;
  for (const auto& line : split(text, "\n")) most = std::max(most, characters(line));
  return most;
}

std::size_t count(const std::string& text, const std::string& part) { return split(text, part).size() - 1; }

TEST(Tables, FitTheRequestedWidth) {
  for (const int rows : {1, 2, 5, 12}) {
    const auto wide = wide_table(rows);
    const auto whole = to_text(wide);
    ASSERT_GT(widest(whole), 120U);
    for (const std::size_t columns : {60U, 80U, 120U}) {
      const auto text = to_text(wide, View::nearest, {true, columns, {}, {}});
      EXPECT_LE(widest(text), columns) << text;
      EXPECT_EQ(count(text, "0.6812 ± 0.0037"), count(whole, "0.6812 ± 0.0037")) << "no number is divided or lost";
      for (const auto& quantity : all_quantities()) {
        EXPECT_NE(text.find(quantity.name), std::string::npos) << quantity.name << " at " << columns << '\n' << text;
      }
    }
  }
  EXPECT_EQ(to_text(table(), View::nearest, {true, 1000, {}, {}}), to_text(table()))
      << "narrow tables stay as they are";
}

TEST(Tables, DividedColumnsRepeatTheirKeys) {
  const std::vector<Cells> lines{{"key", "first", "second"}, {"a", "1", "2"}, {"b", "3", "4"}, {"c", "5", "6"}};
  EXPECT_EQ(fitted(lines, 1, 12),
            "key   first\na         1\nb         3\nc         5\n\n"
            "key   second\na          2\nb          4\nc          6\n");
  EXPECT_EQ(fitted(lines, 1, 0), fitted(lines, 1, 23));
  // Nothing fits into 3 characters, so the narrower form is used.
  EXPECT_EQ(fitted(lines, 1, 3).rfind("key      a\nfirst    1\nsecond   2\n\nkey      b\n", 0), 0U)
      << fitted(lines, 1, 3);
}

TEST(Tables, TextsAreWrappedBetweenWords) {
  EXPECT_EQ(wrapped("one two three", 7), "one two\nthree");
  EXPECT_EQ(wrapped("one two three", 0), "one two three");
  EXPECT_EQ(wrapped("extraordinary one", 5), "extraordinary\none");
  EXPECT_EQ(wrapped("", 5), "");
}

TEST(Tables, FurtherTablesArePrintedOnRequest) {
  const auto wide = wide_table(1);
  const auto first = to_text(wide, View::nearest, {false, 0, "The option --all", {}});
  EXPECT_EQ(first.find("Q6"), std::string::npos) << first;
  EXPECT_NE(first.find("\nThe option --all prints more tables: other cut-offs, critical angles, "), std::string::npos)
      << first;
  EXPECT_EQ(to_text(table(), View::nearest, {false, 0, "The option --all", {}}), to_text(table()))
      << "there are no others";
  const auto all = to_text(wide, View::nearest, {true, 0, "The option --all", {}});
  EXPECT_EQ(all.find("The option --all"), std::string::npos);
  const auto added = to_text(wide, View::nearest, {false, 0, "", {Measure::order}});
  EXPECT_NE(added.find("\n\norder: "), std::string::npos) << added;
  EXPECT_EQ(added.find("\n\nmodes: "), std::string::npos) << added;
  std::set<std::string_view> names;
  for (const auto& quantity : all_quantities()) {
    if (quantity.group == main_group || !names.insert(quantity.group.name).second) continue;
    const auto line = fmt::format("\n\n{}: {}\nsolid ", quantity.group.name, quantity.group.meaning);
    EXPECT_NE(all.find(line), std::string::npos) << line << all;
    EXPECT_EQ(quantity.group.meaning.back(), '.') << "a sentence";
  }
  EXPECT_GT(names.size(), 8U);
}

}  // namespace
}  // namespace isojam
