#include <gtest/gtest.h>

#include <map>
#include <set>
#include <span>

#include "tasks/extras/chart/atlas/atlas.hpp"
#include "tests/tasks/extras/chart/atlas_expected.hpp"

namespace isojam::test {
namespace {

char letter(const AtlasRow& row) { return to_string(row.verdict).front(); }

std::string text_of(const AtlasRow& row) {
  return row.regime + " | " + row.setting + " | " + row.method + ": " + std::string(to_string(row.verdict)) + ", " +
         row.figure + " (" + row.reason + ")";
}

void expect_as_told(const std::vector<AtlasRow>& rows, std::span<const ExpectedCells> table) {
  std::map<std::pair<std::string, std::string>, std::string> expected, found;
  for (const ExpectedCells& cells : table)
    EXPECT_TRUE(expected.try_emplace({cells.regime, cells.method}, cells.verdicts).second) << cells.regime << " twice";
  for (const AtlasRow& row : rows) {
    std::string& letters = found[{row.regime, row.method}];
    letters += letter(row);
    const std::string& told = expected[{row.regime, row.method}];
    const bool open = told.size() >= letters.size() && told[letters.size() - 1] == '?';
    if (open && letters.back() != 'f') letters.back() = '?';
    EXPECT_TRUE(told.size() >= letters.size() && told[letters.size() - 1] == letters.back())
        << text_of(row) << "; expected " << told;
  }
  EXPECT_EQ(found, expected);
}

/// Checks the verdicts of isojam's own methods, and the texts of every row.
void expect_sound(const std::vector<AtlasRow>& rows) {
  std::set<std::string> seen;
  for (const AtlasRow& row : rows) {
    EXPECT_FALSE(row.figure.empty()) << text_of(row);
    EXPECT_FALSE(row.reason.empty()) << text_of(row);
    EXPECT_TRUE(seen.insert(row.regime + "|" + row.setting + "|" + row.method).second) << text_of(row);
    if (row.standard) {
      EXPECT_NE(row.verdict, AtlasVerdict::fails) << text_of(row);
    }
  }
}

void check(const std::vector<AtlasRow>& rows, std::span<const ExpectedCells> table) {
  expect_as_told(rows, table);
  expect_sound(rows);
  std::map<std::string, int> verdicts;
  for (const AtlasRow& row : rows) ++verdicts[std::string(to_string(row.verdict))];
  std::printf("%zu cells: %d hold, %d refuse, %d fail\n", rows.size(), verdicts["holds"], verdicts["refuses"],
              verdicts["fails"]);
}

TEST(Atlas, Overlaps) { check(overlap_atlas(), expected_overlaps); }

TEST(Atlas, Packings) { check(packing_atlas(), expected_packings); }

TEST(Atlas, SameBitsEveryTime) {
  const std::vector<AtlasRow> rows = stability_atlas({.jammed_states = false}), again = packing_atlas();
  ASSERT_GT(rows.size(), again.size());
  const std::size_t first = rows.size() - again.size();
  for (std::size_t k = 0; k < again.size(); ++k) EXPECT_EQ(text_of(rows[first + k]), text_of(again[k]));
}

const AtlasStates& states() {
  static const AtlasStates made;
  return made;
}

TEST(AtlasOfJammedStates, StoppedCellsGiveNoRow) {
  std::stop_source stopped;
  stopped.request_stop();
  EXPECT_TRUE(AtlasStates(stopped.get_token()).empty());
  EXPECT_EQ(minimiser_atlas(states(), stopped.get_token()).size(), 0);
  EXPECT_EQ(modes_atlas(states(), stopped.get_token()).size(), 0);
}

TEST(AtlasOfJammedStates, Minimisers) { check(minimiser_atlas(states()), expected_minimisers); }

TEST(AtlasOfJammedStates, Modes) { check(modes_atlas(states()), expected_modes); }

}  // namespace
}  // namespace isojam::test
