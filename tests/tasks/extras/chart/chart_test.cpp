#include <gtest/gtest.h>

#include <fmt/format.h>

#include <chrono>
#include <csignal>
#include <limits>
#include <map>
#include <string>
#include <thread>

#include "tasks/extras/chart/data.hpp"
#include "tasks/extras/chart/run_chart.hpp"
#include "tasks/io/input_error.hpp"
#include "tasks/io/parse.hpp"
#include "tests/tasks/support/schema.hpp"
#include "tests/tasks/support/support.hpp"

namespace isojam {
namespace {

using namespace std::chrono_literals;
using test::violations;

// ---- Configuration ----------------------------------------------------------------------------------------------

TEST(ChartConfig, IsReadAsItIsWritten) {
  EXPECT_EQ(written(parse_chart_config("{}", "empty")), written(ChartConfig()));
  for (const ChartConfig& config : {ChartConfig(), full_chart_config()}) {
    const Json json = written(config);
    EXPECT_EQ(written(parse_chart_config(json.dump(), "canonical")), json);
    EXPECT_EQ(violations("chart", json), "") << json;
  }
  EXPECT_NE(written(full_chart_config()), written(ChartConfig()));
}

struct BadConfig {
  std::string text, pointer, allowed, suggestion;
  bool schema_can_tell = true;
};

TEST(ChartConfig, RejectsInvalidConfigurations) {
  const std::vector<BadConfig> all{
      {R"({"tolerance": [1e-6]})", "/tolerance", "\"tolerances\"", "tolerances"},
      {R"({"compare": ["mode"]})", "/compare/0", "\"modes\"", "modes"},
      {R"({"distances": [0.04, 0]})", "/distances/1", "a number in [0.001, 0.2]", ""},
      {R"({"distances": []})", "/distances", "1 or more", ""},
      {R"({"particles": 8, "solids": ["tetrahedron"]})", "/particles", "at least", "", false},
  };
  for (const BadConfig& bad : all) {
    try {
      parse_chart_config(bad.text, "bad.json");
      ADD_FAILURE() << "accepted: " << bad.text;
    } catch (const InputError& error) {
      EXPECT_EQ(error.details().pointer, bad.pointer) << error.what();
      EXPECT_NE(error.details().correction().find(bad.allowed), std::string::npos) << error.what();
      EXPECT_EQ(error.details().suggestion, bad.suggestion) << error.what();
    }
    EXPECT_NE(violations("chart", parse_json(bad.text, "bad.json")).empty(), bad.schema_can_tell) << bad.text;
  }
}

// ---- Fronts and spreads -----------------------------------------------------------------------------------------

ChartPoint made_up(const std::string& task, const std::string& method, double seconds, std::optional<double> error,
                   bool failed = false) {
  ChartPoint point;
  point.task = task;
  point.method = method;
  point.setting = "made up";
  point.seconds = Spread{seconds, seconds, seconds, 1};
  if (error) point.error = Spread{*error, *error, *error, 1};
  point.stopped = failed ? "budget" : "done";
  point.failed = failed;
  return point;
}

TEST(ChartFront, ContainsTheBestPoints) {
  const ChartFamily family{
      "equilibrium",
      "error",
      "note",
      FamilyEnd::complete,
      {made_up("t", "slow and exact", 9, 1e-9), made_up("t", "beaten", 5, 1e-3), made_up("t", "fast", 1, 1e-2),
       made_up("t", "good", 4, 1e-6), made_up("t", "same as good", 4, 1e-6), made_up("t", "failed", 0.1, 0, true),
       made_up("t", "no error", 0.1, {}), made_up("t", "as fast, worse", 1, 1e-1),
       made_up("another case", "alone", 100, 1)}};
  const Json data = chart_data(ChartConfig(), {{family}, {}, {}});
  std::vector<std::string> front;
  for (const Json& point : data.at("families")[0].at("points")) {
    if (point.at("on_front")) front.push_back(point.at("method"));
  }
  EXPECT_EQ(front, (std::vector<std::string>{"slow and exact", "fast", "good", "alone"}));
}

TEST(ChartSpread, IsOfFiniteValues) {
  const double infinite = std::numeric_limits<double>::infinity();
  const auto odd = spread({3, infinite, 1, 2}), even = spread({4, 1, 2, 3});
  ASSERT_TRUE(odd && even);
  EXPECT_EQ(odd->median, 2);
  EXPECT_EQ(odd->n, 3);
  EXPECT_EQ(even->median, 2.5);
  EXPECT_EQ(even->least, 1);
  EXPECT_EQ(even->greatest, 4);
  EXPECT_FALSE(spread({infinite}));
  EXPECT_FALSE(spread({}));
}

// ---- Tables -----------------------------------------------------------------------------------------------------

TEST(ChartTable, HasALetterForEveryCellOfTheAtlas) {
  using enum AtlasVerdict;
  ChartResult result;
  result.atlas = ChartAtlas{FamilyEnd::cut, {}};
  for (const std::string setting : {"1e-4", "1e-6"}) {
    result.atlas->rows.push_back({"depth", setting, "ours", true, holds, "error 0", "within"});
    result.atlas->rows.push_back({"depth", setting, "naive", false, setting == "1e-4" ? holds : fails, "error 1", "?"});
  }
  result.atlas->rows.push_back({"cubes", "one", "ours", true, refuses, "density 1", "limit"});
  const std::string text = text_table(result), pad(50, ' ');
  EXPECT_NE(text.find("atlas (interrupted by the time limit): 3 cells hold (h), 1 refuse (r), 1 fail (f)"),
            std::string::npos)
      << text;
  EXPECT_NE(text.find("\ndepth: 1e-4, 1e-6\n  naive " + pad + "hf\n  ours * " + pad.substr(1) + "hh\ncubes: one\n"),
            std::string::npos)
      << text;
}

// ---- Real charts ------------------------------------------------------------------------------------------------

ChartConfig tiny_config() {
  return parse_chart_config(
      R"({"compare": ["equilibrium", "hessian", "modes", "overlap"], "solids": ["dodecahedron"], "particles": 24,
          "packings": 1, "distances": [0.08, 0.05], "fit_window": 0.1,
          "tolerances": [1e-2, 1e-6], "difference_steps": [1e-7], "shifts": [1e-11], "subspaces": [100], "pairs": 3,
          "repetitions": 1, "max_evaluations": 300, "rule_evaluations": 600, "point_seconds": 100, "total_seconds": 1000})",
      "tiny");
}

Json tiny_data() {
  Console console({.quiet = true});
  return chart_data(tiny_config(), run_chart(tiny_config(), {}, console));
}

/// The data without times.
Json without_times(Json data) {
  data.erase("cpu_seconds");
  for (Json& family : data.at("families")) {
    for (Json& point : family.at("points")) {
      point.erase("seconds");
      point.erase("on_front");
    }
  }
  return data;
}

TEST(Chart, OfEverythingConformsAndIsReproducible) {
  const Json data = tiny_data();
  EXPECT_EQ(violations("chart_data", data), "");
  EXPECT_EQ(violations("chart", data.at("config")), "");
  std::vector<std::string> names;
  for (const Json& family : data.at("families")) {
    names.push_back(family.at("name"));
    EXPECT_EQ(family.at("ended"), "complete") << family.at("name");
    EXPECT_FALSE(family.at("points").empty()) << family.at("name");
    for (const Json& point : family.at("points")) {
      EXPECT_FALSE(point.at("seconds").is_null()) << point;
      const auto setting = point.at("setting").get<std::string>();
      if (family.at("name") != "equilibrium" || !setting.starts_with("residual ")) continue;
      const bool reached = point.at("error").at("greatest").get<double>() <= std::stod(setting.substr(9));
      EXPECT_EQ(!reached, point.at("failed") == true) << point;
    }
  }
  EXPECT_EQ(names, (std::vector<std::string>{"equilibrium", "bias", "hessian", "modes", "overlap"}));
  EXPECT_EQ(without_times(data).dump(), without_times(tiny_data()).dump());
  auto damaged = data;
  damaged["families"][0]["points"][0].erase("stopped");
  EXPECT_NE(violations("chart_data", damaged), "");
}

TEST(Chart, StatesThatItsTimeWasOver) {
  ChartConfig config = tiny_config();
  config.compare = ChartConfig().compare;
  config.total_seconds = 1e-3;
  Console console({.quiet = true});
  const ChartResult result = run_chart(config, {}, console);
  ASSERT_EQ(result.families.size(), 5);
  for (const ChartFamily& family : result.families) EXPECT_EQ(family.ended, FamilyEnd::cut) << family.name;
  ASSERT_TRUE(result.atlas);
  EXPECT_EQ(result.atlas->ended, FamilyEnd::cut);
  EXPECT_TRUE(result.atlas->rows.empty());
  EXPECT_EQ(violations("chart_data", chart_data(config, result)), "");
  const std::string text = text_table(result);
  EXPECT_NE(text.find("equilibrium (interrupted by the time limit)"), std::string::npos) << text;
  EXPECT_NE(text.find("atlas (interrupted by the time limit)"), std::string::npos) << text;
}

struct Interrupted {
  test::Finished ended;
  std::map<std::string, std::string> files;
};

/// Makes a chart with these comparisons and the built-in configuration, which takes minutes. Interrupts it one second
/// after it wrote its first part. If `at_once` is true, interrupts it two seconds after the start.
Interrupted interrupted_chart(const std::string& compared, bool at_once) {
  const test::TemporaryDirectory directory;
  test::write_text(directory / "config.json", "{\"compare\": " + compared + "}");
  Interrupted result;
  result.ended = test::isojam({"chart", "config.json", "-o", "out", "--quiet"}, directory.path(), [&](int process) {
    for (int k = 0; k < 60000 && !at_once && !std::filesystem::exists(directory / "out/chart.html"); ++k)
      std::this_thread::sleep_for(10ms);
    std::this_thread::sleep_for(at_once ? 2s : 1s);
    kill(process, SIGINT);
  });
  result.files = test::files_below(directory / "out");
  return result;
}

TEST(Chart, ASignalKeepsTheMeasurements) {
  struct Case {
    std::string compared;
    std::map<std::string, std::string> ends;  ///< how each family and the atlas ended
    bool at_once = false;
  };
  const std::vector<Case> all{
      {R"(["equilibrium", "hessian"])",
       {{"equilibrium", "interrupted"}, {"bias", "interrupted"}, {"hessian", "interrupted"}},
       true},
      {R"(["overlap", "atlas"])", {{"overlap", "complete"}, {"atlas", "interrupted"}}},
  };
  for (const Case& each : all) {
    const Interrupted found = interrupted_chart(each.compared, each.at_once);
    EXPECT_EQ(found.ended.exit_code, 75) << each.compared << found.ended.err;
    ASSERT_EQ(found.files.size(), 3) << each.compared;
    const Json data = parse_json(found.files.at("data.json"), "data.json");
    EXPECT_EQ(violations("chart_data", data), "");
    std::map<std::string, std::string> ends;
    for (const Json& family : data.at("families")) ends[family.at("name")] = family.at("ended");
    if (data.contains("atlas")) ends["atlas"] = data.at("atlas").at("ended");
    EXPECT_EQ(ends, each.ends) << each.compared;
    EXPECT_NE(found.files.at("table.txt").find("(interrupted by a signal)"), std::string::npos);
    EXPECT_NE(found.files.at("chart.html").find("\"ended\":\"interrupted\""), std::string::npos);
  }
}

TEST(Chart, CommandWritesItsFiles) {
  const test::TemporaryDirectory directory;
  test::write_text(directory / "config.json", R"({"compare": ["overlap"], "solids": ["cube"], "pairs": 2})");
  const auto done = test::isojam({"chart", "config.json", "-o", "out", "--quiet"}, directory.path());
  EXPECT_EQ(done.exit_code, 0) << done.err;
  const auto files = test::files_below(directory / "out");
  ASSERT_EQ(files.size(), 3);
  EXPECT_EQ(files.at("table.txt"), done.out);
  EXPECT_NE(files.at("chart.html").find("<!doctype html>"), std::string::npos);
  EXPECT_EQ(violations("chart_data", parse_json(files.at("data.json"), "data.json")), "");

  test::write_text(directory / "bad.json", R"({"pair": 2})");
  const auto refused = test::isojam({"chart", "bad.json", "-o", "other"}, directory.path());
  EXPECT_EQ(refused.exit_code, 65) << refused.err;
  EXPECT_NE(refused.err.find("did you mean"), std::string::npos) << refused.err;
  EXPECT_FALSE(std::filesystem::exists(directory / "other"));
}

}  // namespace
}  // namespace isojam
