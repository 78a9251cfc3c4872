#include <gtest/gtest.h>

#include <fmt/format.h>

#include <limits>

#include "tasks/extras/chart/conclusion.hpp"
#include "tasks/extras/chart/data.hpp"
#include "tasks/extras/chart/front.hpp"
#include "tasks/extras/chart/run_chart.hpp"
#include "tasks/io/input_error.hpp"
#include "tasks/io/parse.hpp"
#include "tests/tasks/support/schema.hpp"
#include "tests/tasks/support/support.hpp"

namespace isojam {
namespace {

using test::violations;

// ---- Configuration ----------------------------------------------------------------------------------------------

TEST(ChartConfig, IsReadAsItIsWritten) {
  EXPECT_EQ(to_json(parse_chart_config("{}", "empty")), to_json(ChartConfig()));
  for (const ChartConfig& config : {ChartConfig(), full_chart_config()}) {
    const Json json = to_json(config);
    EXPECT_EQ(to_json(parse_chart_config(json.dump(), "canonical")), json);
    EXPECT_EQ(violations("chart", json), "") << json;
  }
  EXPECT_NE(to_json(full_chart_config()), to_json(ChartConfig()));
}

TEST(ChartConfig, HasTheDefaultsOfItsSchema) {
  const Json properties = test::schema("chart").at("properties"), defaults = to_json(ChartConfig());
  for (const auto& item : defaults.items()) {
    ASSERT_TRUE(properties.contains(item.key())) << item.key();
    const Json& property = properties.at(item.key());
    if (!item.value().is_object()) {
      EXPECT_EQ(property.at("default"), item.value()) << item.key();
      continue;
    }
    for (const auto& inner : item.value().items())
      EXPECT_EQ(property.at("properties").at(inner.key()).at("default"), inner.value()) << inner.key();
  }
}

struct BadConfig {
  std::string text, pointer, allowed, suggestion;
  bool schema_can_tell = true;
};

TEST(ChartConfig, RejectsInvalidConfigurations) {
  const std::vector<BadConfig> all{
      {R"({"tolerance": [1e-6]})", "/tolerance", "\"tolerances\"", "tolerances"},
      {R"({"phi_j": {"replicate": 3}})", "/phi_j/replicate", "\"replicates\"", "replicates"},
      {R"({"solids": ["octahedral"]})", "/solids/0", "\"octahedron\"", "octahedron"},
      {R"({"compare": ["mode"]})", "/compare/0", "\"modes\"", "modes"},
      {R"({"distances": [0.04, 0]})", "/distances/1", "a number in [0.001, 0.2]", ""},
      {R"({"distances": []})", "/distances", "one or more", ""},
      {R"({"tolerances": [1e-6, 1e-6]})", "/tolerances/1", "each value once", ""},
      {R"({"repetitions": 0.5})", "/repetitions", "an integer from 1 to 1000", ""},
      {R"({"point_seconds": 0})", "/point_seconds", "a number in (0, 1000000]", ""},
      {R"({"phi_j": {"replicates": 1}})", "/phi_j/replicates", "an integer from 2", ""},
      {R"({"particles": 8, "solids": ["tetrahedron"]})", "/particles", "at least", "", false},
      {R"({"growth": {"distance": [0.03]}})", "/growth/distance", "\"distances\"", "distances"},
      {R"({"growth": {"particles": [50, 50]}})", "/growth/particles/1", "each value once", ""},
      {R"({"growth": {"particles": [100, 8]}})", "/growth", "at least", "", false},
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

TEST(ChartConfig, ReportsAllErrorsAtOnce) {
  try {
    parse_chart_config(R"({"distances": [0.04, 0, 1], "tolerance": 1, "phi_j": {"replicates": 1, "solid": 1}})",
                       "bad.json");
    ADD_FAILURE();
  } catch (const InputError& error) {
    std::vector<std::string> pointers;
    for (const auto& each : error.all()) pointers.push_back(each.pointer);
    EXPECT_EQ(pointers, (std::vector<std::string>{"/distances/1", "/distances/2", "/tolerance", "/phi_j/replicates",
                                                  "/phi_j/solid"}));
  }
}

// ---- Fronts, spreads, conclusions -------------------------------------------------------------------------------

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
  const std::vector<ChartPoint> points{
      made_up("t", "slow and exact", 9, 1e-9), made_up("t", "beaten", 5, 1e-3),
      made_up("t", "fast", 1, 1e-2),           made_up("t", "good", 4, 1e-6),
      made_up("t", "same as good", 4, 1e-6),   made_up("t", "failed", 0.1, 0, true),
      made_up("t", "no error", 0.1, {}),       made_up("t", "as fast, worse", 1, 1e-1)};
  EXPECT_EQ(pareto_front(points), (std::vector<std::size_t>{2, 3, 0}));
  EXPECT_TRUE(pareto_front({}).empty());
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

/// Points with a requested residual of 1e-6, and slower points with 1e-9.
std::vector<ChartPoint> made_up_equilibrium() {
  std::vector<ChartPoint> points{made_up("a", "newton", 2, 1e-10),     made_up("a", "newton", 1, 1e-7),
                                 made_up("b", "newton", 3, 1e-7),      made_up("a", "lbfgs", 0.1, 1e-7),
                                 made_up("b", "lbfgs", 9, 1e-2, true), made_up("a", "fire", 5, 1e-10),
                                 made_up("b", "fire", 6, 1e-6)};
  for (ChartPoint& point : points) point.setting = "residual 1e-06";
  points.front().setting = "residual 1e-09";
  points.push_back(made_up("a", "by energy", 0.5, 0.2));
  points.back().setting = "energy change 1e-12";
  return points;
}

TEST(ChartConclusion, RanksByCasesThenByTime) {
  const auto ranking = standings(made_up_equilibrium(), 1e-6);
  ASSERT_EQ(ranking.size(), 4);
  // Newton and FIRE reach both cases; Newton needs 1 + 3 s with its faster setting. L-BFGS is faster in the case that
  // it reaches.
  EXPECT_EQ(ranking[0].method, "newton");
  EXPECT_EQ(ranking[0].reached, 2);
  EXPECT_DOUBLE_EQ(ranking[0].seconds, 4);
  EXPECT_EQ(ranking[1].method, "fire");
  EXPECT_EQ(ranking[2].method, "lbfgs");
  EXPECT_EQ(ranking[2].tasks, 2);
  EXPECT_EQ(ranking[3].reached, 0);
}

TEST(ChartConclusion, IsInSentencesAboutTheRequestedResiduals) {
  ChartPoint bias = made_up("a", "by energy", 1, 0.004);
  bias.setting = "energy change 1e-12";
  const auto lines = conclusion(made_up_equilibrium(), std::vector{bias});
  const std::vector<std::string> expected{
      "The residual 1e-06 is reached in all 2 cases only by newton and fire. The fastest method is lbfgs in 1 of 2 "
      "cases "
      "and newton in 1. It is missed by lbfgs in 1 of 2 cases.",
      "The residual 1e-09 is reached by no method in all 2 cases; newton reaches it in the most, 1 of 2. newton is the "
      "fastest in all of them. It is missed by lbfgs in 2 of 2 cases, fire in 1 and newton in 1.",
      "The paper's rule stops a minimisation at energy changes below 1e-12. It stops in 1 of 1 cases, with residuals "
      "up to 0.2 and errors of phi_J up to 0.004."};
  EXPECT_EQ(lines, expected);
  EXPECT_EQ(conclusion({}, {}), std::vector<std::string>{"No minimiser was measured."});
  auto hopeless = made_up("a", "fire", 1, 0.5, true);
  hopeless.setting = "residual 1e-03";
  EXPECT_EQ(
      conclusion(std::vector{hopeless}, {}),
      std::vector<std::string>{"The residual 0.001 is reached by no method in any case. It is missed by fire in 1 "
                               "of 1 cases."});
}

TEST(ChartConclusion, StatesWhereAMethodIsFasterOrFails) {
  std::vector<ChartPoint> points;
  for (const std::string distance : {"0.1", "0.03", "0.01"}) {
    for (const std::string solid : {"cube", "tetrahedron"}) {
      const auto task = solid + ", Δφ = " + distance;
      const bool near = distance == "0.01", far = distance == "0.1";
      points.push_back(made_up(task, "newton", near ? 5 : 1, 1e-8));
      points.push_back(made_up(task, "multipliers", 2, 1e-8));
      points.push_back(made_up(task, "conjugate_gradient", 9, far ? 1e-7 : 1e-2, !far));
    }
  }
  for (ChartPoint& point : points) point.setting = "residual 1e-06";
  const std::string expected =
      "The residual 1e-06 is reached in all 6 cases only by multipliers and newton. The fastest method is newton in 4 "
      "of "
      "6 cases at Δφ ≥ 0.03 and multipliers in 2 at Δφ ≤ 0.01. It is missed by conjugate gradient in 4 of 6 cases at "
      "Δφ ≤ 0.03.";
  EXPECT_EQ(conclusion(points, {}), std::vector<std::string>{expected});
}

// ---- Real charts ------------------------------------------------------------------------------------------------

ChartConfig tiny_config() {
  return parse_chart_config(
      R"({"compare": ["equilibrium", "hessian", "modes", "overlap", "phi_j", "growth"], "solids": ["dodecahedron"], "particles": 24, "packings": 1, "distances": [0.08, 0.05], "fit_window": 0.1,
          "tolerances": [1e-2, 1e-6], "difference_steps": [1e-7], "shifts": [1e-11], "subspaces": [100], "pairs": 3,
          "repetitions": 1, "max_evaluations": 300, "rule_evaluations": 600, "point_seconds": 100, "total_seconds": 1000,
          "phi_j": {"solid": "dodecahedron", "replicates": 2, "particles": [24], "consolidation_step": [0.04],
                    "target_energy": [1e-5], "fit_window": [0.05, 0.1], "residual": [1e-6]},
          "growth": {"solids": ["dodecahedron"], "particles": [24, 30], "replicates": 1, "distances": [0.05]}})",
      "tiny");
}

Json tiny_data() {
  Console console({.quiet = true});
  return chart_data(tiny_config(), run_chart(tiny_config(), {}, console));
}

/// The data without times and without the statements about the fastest method.
Json without_times(Json data) {
  data.erase("conclusion");
  data.erase("cpu_seconds");
  for (Json& family : data.at("families")) {
    family.erase("fits");
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
    for (const Json& point : family.at("points")) EXPECT_FALSE(point.at("seconds").is_null()) << point;
  }
  EXPECT_EQ(names, (std::vector<std::string>{"equilibrium", "bias", "hessian", "modes", "overlap", "phi_j", "growth"}));
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
  ASSERT_EQ(result.families.size(), 7);
  for (const ChartFamily& family : result.families) EXPECT_EQ(family.ended, FamilyEnd::cut) << family.name;
  ASSERT_TRUE(result.atlas);
  EXPECT_EQ(result.atlas->ended, FamilyEnd::cut);
  EXPECT_TRUE(result.atlas->rows.empty());
  EXPECT_EQ(violations("chart_data", chart_data(config, result)), "");
  const std::string text = text_table(result);
  EXPECT_NE(text.find("equilibrium (interrupted by the time limit)"), std::string::npos) << text;
  EXPECT_NE(text.find("atlas (interrupted by the time limit)"), std::string::npos) << text;
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
