#include "tasks/extras/chart/atlas/atlas_runs.hpp"

#include <gtest/gtest.h>

#include "tasks/extras/chart/data.hpp"

namespace isojam {
namespace {

AtlasRow cell(const std::string& regime, const std::string& setting, const std::string& method, AtlasVerdict verdict,
              const std::string& reason) {
  return {regime, setting, method, method == "ours", verdict, "error at " + setting, reason};
}

std::vector<AtlasRow> made_up_rows() {
  std::vector<AtlasRow> rows;
  const auto add = [&rows](const std::string& setting, AtlasVerdict verdict, const std::string& reason) {
    rows.push_back(cell("depth", setting, "ours", AtlasVerdict::holds, "within"));
    rows.push_back(cell("depth", setting, "naive", verdict, reason));
  };
  add("1", AtlasVerdict::fails, "wrong sign");
  add("2", AtlasVerdict::holds, "within");
  add("3", AtlasVerdict::holds, "within, barely");
  add("4", AtlasVerdict::refuses, "budget");
  add("5", AtlasVerdict::fails, "wrong sign");
  add("6", AtlasVerdict::fails, "not within");
  add("7", AtlasVerdict::holds, "within");
  add("8", AtlasVerdict::fails, "not within");
  add("9", AtlasVerdict::fails, "not within");
  rows.push_back(cell("cubes", "one", "ours", AtlasVerdict::refuses, "density limit"));
  rows.push_back(cell("depth", "10", "naive", AtlasVerdict::fails, "not within"));
  return rows;
}

std::string text_of(const AtlasRun& run) {
  return run.regime + "|" + run.method + (run.standard ? "*" : "") + "|" + std::string(to_string(run.verdict)) + "|" +
         run.settings + "|" + run.reason + "|" + run.figure;
}

TEST(ChartAtlas, CellsWithTheSameVerdictFormAGroup) {
  std::vector<std::string> found;
  for (const AtlasRun& run : atlas_runs(made_up_rows())) found.push_back(text_of(run));
  EXPECT_EQ(found, (std::vector<std::string>{
                       "depth|ours*|holds|1 … 9|within|error at 1", "depth|naive|holds|2, 3, 7|within|error at 2",
                       "depth|naive|refuses|4|budget|error at 4", "depth|naive|fails|1, 5|wrong sign|error at 1",
                       "depth|naive|fails|6, 8 … 10|not within|error at 6",
                       "cubes|ours*|refuses|one|density limit|error at one"}));
  EXPECT_TRUE(atlas_runs({}).empty());
}

TEST(ChartAtlas, TheTableStatesWhatDoesNotHold) {
  ChartResult result;
  result.atlas = ChartAtlas{FamilyEnd::complete, made_up_rows()};
  const std::string text = text_table(result);
  for (const std::string part :
       {"atlas: 12 cells hold, 2 refuse, 6 fail", "FAILS    6, 8 … 10  not within (error at 6)",
        "REFUSES  4          budget (error at 4)", "cubes   ours *  REFUSES  one        density limit (error at one)"})
    EXPECT_NE(text.find(part), std::string::npos) << part << "\n" << text;
  EXPECT_EQ(text.find("error at 2"), std::string::npos) << text;
}

TEST(ChartAtlas, DataContainEveryCell) {
  ChartResult result;
  EXPECT_TRUE(chart_data(ChartConfig(), result).at("atlas").is_null());
  result.atlas = ChartAtlas{FamilyEnd::cut, made_up_rows()};
  result.costs = {{"atlas", 2.5}};
  const Json data = chart_data(ChartConfig(), result);
  EXPECT_EQ(data.at("atlas").at("ended"), "cut");
  ASSERT_EQ(data.at("atlas").at("rows").size(), made_up_rows().size());
  EXPECT_EQ(data.at("atlas").at("rows")[7], (Json{{"regime", "depth"},
                                                  {"setting", "4"},
                                                  {"method", "naive"},
                                                  {"standard", false},
                                                  {"verdict", "refuses"},
                                                  {"figure", "error at 4"},
                                                  {"reason", "budget"}}));
  EXPECT_EQ(data.at("cpu_seconds"), (Json{{"atlas", 2.5}}));
}

}  // namespace
}  // namespace isojam
