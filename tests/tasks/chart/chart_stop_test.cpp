// Facts proved here:
// - a signal in any part of a chart ends the command with exit code 75 within seconds, its three files written: parts
//   that ended before are complete, the one under way and those after it say that they were interrupted;
// - after each part there is a chart in which what is still to come stands as interrupted and empty;
// - Hessians and modes look at the same equilibria, made once, as packings are;
// - a family that is stopped in the middle keeps what was measured until then;
// - the atlas ends with the time of the chart; its rows until then are those of the whole atlas, none of them of what
//   was stopped, and conform.

#include <gtest/gtest.h>

#include <chrono>
#include <csignal>
#include <filesystem>
#include <map>
#include <string>
#include <thread>

#include "tasks/chart/families/comparisons.hpp"
#include "tasks/chart/results/data.hpp"
#include "tasks/chart/run_chart.hpp"
#include "tasks/json/parse.hpp"
#include "tests/tasks/support/schema.hpp"
#include "tests/tasks/support/support.hpp"

namespace isojam {
namespace {

using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;
using test::violations;

double seconds_since(Clock::time_point begun) { return std::chrono::duration<double>(Clock::now() - begun).count(); }

// ---- Signals ----------------------------------------------------------------------------------------------------

struct Interrupted {
  test::Finished ended;
  double seconds_after_signal = 0;
  std::map<std::string, std::string> files;
};

/// A chart of these comparisons by the built-in configuration, interrupted once it has written a first part, or after
/// two seconds if `at_once`.
Interrupted interrupted_chart(const std::string& compared, bool at_once) {
  const test::TemporaryDirectory directory;
  test::write_text(directory / "config.json", "{\"compare\": " + compared + "}");
  Clock::time_point sent;
  Interrupted result;
  result.ended = test::isojam({"chart", "config.json", "-o", "out", "--quiet"}, directory.path(), [&](int process) {
    const auto begun = Clock::now();
    while (!at_once && !std::filesystem::exists(directory / "out/chart.html") && seconds_since(begun) < 60)
      std::this_thread::sleep_for(10ms);
    std::this_thread::sleep_for(at_once ? 2s : 1s);
    sent = Clock::now();
    kill(process, SIGINT);
  });
  result.seconds_after_signal = seconds_since(sent);
  result.files = test::files_below(directory / "out");
  return result;
}

TEST(ChartStop, ASignalLeavesWhatWasMeasured) {
  struct Case {
    std::string compared;
    std::map<std::string, std::string> ends;  ///< of families and atlas
    bool at_once = false;
  };
  const std::vector<Case> all{
      {R"(["equilibrium", "hessian"])",
       {{"equilibrium", "interrupted"}, {"bias", "interrupted"}, {"hessian", "interrupted"}},
       true},
      {R"(["overlap", "atlas", "phi_j"])",
       {{"overlap", "complete"}, {"atlas", "interrupted"}, {"phi_j", "interrupted"}}},
      {R"(["overlap", "phi_j"])", {{"overlap", "complete"}, {"phi_j", "interrupted"}}},
  };
  for (const Case& each : all) {
    const Interrupted found = interrupted_chart(each.compared, each.at_once);
    EXPECT_EQ(found.ended.exit_code, 75) << each.compared << found.ended.err;
    EXPECT_LT(found.seconds_after_signal, 10) << each.compared;
    ASSERT_EQ(found.files.size(), 3) << each.compared;
    const Json data = parse_json(found.files.at("data.json"), "data.json");
    EXPECT_EQ(violations("chart_data", data), "");
    std::map<std::string, std::string> ends;
    for (const Json& family : data.at("families")) ends[family.at("name")] = family.at("ended");
    if (!data.at("atlas").is_null()) ends["atlas"] = data.at("atlas").at("ended");
    EXPECT_EQ(ends, each.ends) << each.compared;
    EXPECT_NE(found.files.at("table.txt").find("(CUT: interrupted)"), std::string::npos);
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

int measurements(const ChartFamily& family) {
  int n = 0;
  for (const ChartPoint& point : family.points) n += point.seconds ? point.seconds->n : 0;
  return n;
}

/// How much of a family there is when it is stopped after a share of the time that all of it takes.
template <class Compare>
void expect_kept_when_stopped(const ChartConfig& config, const Compare& compare) {
  Console console({.quiet = true});
  const Measuring unstopped{config, {}, console};
  const auto tasks = all_equilibria(jam_all(unstopped), unstopped);
  ASSERT_EQ(tasks.size(), 1);
  ASSERT_EQ(tasks[0].packings.size(), 2);
  ChartFamily whole;
  const auto begun = Clock::now();
  compare(tasks, unstopped, whole);
  const double seconds = seconds_since(begun);
  const int all = measurements(whole);
  std::string tried;
  // The machine may be busy with other things: any share of the time that ends in the middle will do.
  for (const double share : {0.7, 0.5, 0.85, 0.3, 0.6, 1.2, 2.0}) {
    const Deadline deadline(share * seconds, {});
    ChartFamily part;
    compare(tasks, Measuring{config, deadline.token(), console}, part);
    const int kept = measurements(part);
    tried += " " + std::to_string(kept);
    if (0 < kept && kept < all) return;
  }
  ADD_FAILURE() << "never in the middle: of " << all << " measurements" << tried;
}

TEST(ChartStop, HessiansAndModesKeepWhatWasMeasured) {
  expect_kept_when_stopped(small_config(R"("difference_steps": [1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9, 1e-10])"),
                           compare_hessians);
  expect_kept_when_stopped(small_config(R"("subspaces": [60, 70, 80, 90], "shifts": [1e-6, 1e-8, 1e-10, 1e-12])"),
                           compare_modes);
}

TEST(ChartStop, TheAtlasEndsWithTheTime) {
  const auto begun = Clock::now();
  const auto expected = stability_atlas({.jammed_states = false});
  // Enough for these, not for the rest, which takes many times as long, on a machine that is busy with other things.
  const double time = 1 + 2 * seconds_since(begun);
  ChartConfig config = parse_chart_config(R"({"compare": ["atlas"]})", "atlas");
  config.total_seconds = time;
  Console console({.quiet = true});
  const auto begun_again = Clock::now();
  const ChartResult result = run_chart(config, {}, console);
  EXPECT_LT(seconds_since(begun_again), 2 * time + 2);
  ASSERT_TRUE(result.atlas);
  EXPECT_EQ(result.atlas->ended, FamilyEnd::cut);
  ASSERT_GE(result.atlas->rows.size(), expected.size());
  for (std::size_t k = 0; k < expected.size(); ++k) {
    EXPECT_EQ(result.atlas->rows[k].regime, expected[k].regime) << k;
    EXPECT_EQ(result.atlas->rows[k].figure, expected[k].figure) << k;
  }
  for (const AtlasRow& row : result.atlas->rows) EXPECT_NE(row.reason, "interrupted") << row.regime << row.setting;
  const Json data = chart_data(config, result);
  EXPECT_EQ(violations("chart_data", data), "");
  EXPECT_EQ(data.at("atlas").at("rows").size(), result.atlas->rows.size());
  for (const auto& [key, wrong] :
       std::map<std::string, Json>{{"verdict", "perhaps"}, {"reason", ""}, {"standard", 1}}) {
    Json damaged = data;
    damaged["atlas"]["rows"][0][key] = wrong;
    EXPECT_NE(violations("chart_data", damaged), "") << key;
  }
}

}  // namespace
}  // namespace isojam
