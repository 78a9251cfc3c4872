#include <gtest/gtest.h>

#include <chrono>
#include <csignal>
#include <filesystem>
#include <map>
#include <stop_token>
#include <string>
#include <thread>

#include "tasks/extras/chart/comparisons.hpp"
#include "tasks/extras/chart/data.hpp"
#include "tasks/extras/chart/run_chart.hpp"
#include "tasks/io/parse.hpp"
#include "tests/tasks/support/schema.hpp"
#include "tests/tasks/support/support.hpp"

namespace isojam {
namespace {

using namespace std::chrono_literals;
using test::violations;

// ---- Signals ----------------------------------------------------------------------------------------------------

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

TEST(ChartStop, ASignalKeepsTheMeasurements) {
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

// ---- Parts ------------------------------------------------------------------------------------------------------

ChartConfig small_config(const std::string& rest) {
  return parse_chart_config(
      R"({"solids": ["dodecahedron"], "particles": 24, "packings": 2, "distances": [0.08], "repetitions": 1,)" + rest +
          "}",
      "small");
}

TEST(ChartStop, EachPartIsPublished) {
  const ChartConfig config = small_config(
      R"("compare": ["hessian", "modes", "overlap"], "pairs": 2, "difference_steps": [1e-7], "subspaces": [60])");
  Console console({.quiet = true});
  std::vector<std::string> ends, parts;
  const ChartResult result = run_chart(config, {}, console, [&](const ChartResult& so_far) {
    std::string& text = ends.emplace_back();
    for (const ChartFamily& family : so_far.families) {
      text += family.name + " " + std::string(to_string(family.ended)) + "; ";
      EXPECT_EQ(family.points.empty(), family.ended == FamilyEnd::interrupted) << family.name;
    }
    EXPECT_EQ(violations("chart_data", chart_data(config, so_far)), "");
  });
  EXPECT_EQ(ends, (std::vector<std::string>{"hessian complete; modes interrupted; overlap interrupted; ",
                                            "hessian complete; modes complete; overlap interrupted; ",
                                            "hessian complete; modes complete; overlap complete; "}));
  for (const PartCost& cost : result.costs) {
    parts.push_back(cost.part);
    EXPECT_GT(cost.cpu_seconds, 0) << cost.part;
  }
  EXPECT_EQ(parts, (std::vector<std::string>{"packings", "equilibria", "hessian", "modes", "overlap"}));
}

/// Measurements of a family that is stopped when its second packing begins: the first method has points for both
/// packings, all other methods for one.
template <class Compare>
void expect_kept_when_stopped(const ChartConfig& config, const Compare& compare) {
  const Measuring unstopped{config, {}, [](const std::string&) {}};
  const auto tasks = all_equilibria(jam_all(unstopped), unstopped);
  ASSERT_EQ(tasks.size(), 1);
  ASSERT_EQ(tasks[0].packings.size(), 2);
  ChartFamily whole, part;
  compare(tasks, unstopped, whole);
  std::stop_source source;
  int begun = 0;
  compare(tasks,
          Measuring{config, source.get_token(),
                    [&](const std::string&) {
                      if (++begun == 2) source.request_stop();
                    }},
          part);
  ASSERT_EQ(part.points.size(), whole.points.size());
  ASSERT_GT(part.points.size(), 4);
  for (std::size_t k = 0; k < part.points.size(); ++k) {
    EXPECT_EQ(part.points[k].setting, whole.points[k].setting);
    EXPECT_EQ(whole.points[k].seconds->n, 2) << whole.points[k].setting;
    EXPECT_EQ(part.points[k].seconds->n, k == 0 ? 2 : 1) << part.points[k].setting;
  }
}

TEST(ChartStop, HessiansAndModesKeepWhatWasMeasured) {
  expect_kept_when_stopped(small_config(R"("difference_steps": [1e-3, 1e-5, 1e-7, 1e-9])"), compare_hessians);
  expect_kept_when_stopped(small_config(R"("subspaces": [60, 80], "shifts": [1e-6, 1e-10])"), compare_modes);
}

TEST(ChartStop, AStoppedAtlasHasItsFirstRows) {
  const auto first = stability_atlas({.jammed_states = false});
  // The request arrives while the minimisers run.
  std::stop_source source;
  std::jthread later;
  const auto rows = stability_atlas({.stop = source.get_token(), .progress = [&](const std::string& next) {
                                       if (next != "minimisers") return;
                                       later = std::jthread([&] {
                                         std::this_thread::sleep_for(500ms);
                                         source.request_stop();
                                       });
                                     }});
  ASSERT_GE(rows.size(), first.size());
  for (std::size_t k = 0; k < first.size(); ++k) {
    EXPECT_EQ(rows[k].regime, first[k].regime) << k;
    EXPECT_EQ(rows[k].figure, first[k].figure) << k;
  }
  for (const AtlasRow& row : rows) EXPECT_NE(row.reason, "interrupted") << row.regime << row.setting;
  const ChartConfig config = parse_chart_config(R"({"compare": ["atlas"]})", "atlas");
  ChartResult result;
  result.atlas = ChartAtlas{FamilyEnd::interrupted, rows};
  const Json data = chart_data(config, result);
  EXPECT_EQ(violations("chart_data", data), "");
  EXPECT_EQ(data.at("atlas").at("rows").size(), result.atlas->rows.size());
  for (const auto& [key, wrong] : std::map<std::string, Json>{{"verdict", "perhaps"}, {"reason", 1}, {"standard", 1}}) {
    Json damaged = data;
    damaged["atlas"]["rows"][0][key] = wrong;
    EXPECT_NE(violations("chart_data", damaged), "") << key;
  }
}

}  // namespace
}  // namespace isojam
