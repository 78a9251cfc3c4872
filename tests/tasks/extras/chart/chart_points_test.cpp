#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <optional>
#include <sstream>

#include "tasks/extras/chart/data.hpp"
#include "tasks/extras/chart/run_chart.hpp"

namespace isojam {
namespace {

const ChartResult& real_chart() {
  static const ChartResult result = [] {
    const ChartConfig config = parse_chart_config(
        R"({"compare": ["equilibrium", "hessian", "modes", "overlap"], "solids": ["octahedron"], "particles": 45,
            "packings": 2, "distances": [0.08, 0.03], "fit_window": 0.1, "tolerances": [1e-2, 1e-6],
            "difference_steps": [1e-3, 1e-8], "shifts": [1e-11], "subspaces": [60, 200], "pairs": 8, "repetitions": 2,
            "max_evaluations": 400, "rule_evaluations": 800, "point_seconds": 1e5, "total_seconds": 1e6})",
        "points");
    Console console({.quiet = true});
    return run_chart(config, {}, console);
  }();
  return result;
}

std::string text_of(const ChartPoint& point) {
  return point.task + " | " + point.method + " | " + point.setting + " | " + point.stopped;
}

TEST(ChartPoints, HaveSpreadsCountsAndReasons) {
  for (const ChartFamily& family : real_chart().families) {
    ASSERT_FALSE(family.points.empty()) << family.name;
    for (const ChartPoint& point : family.points) {
      EXPECT_FALSE(point.stopped.empty()) << text_of(point);
      ASSERT_TRUE(point.seconds) << text_of(point);
      for (const auto& spread : {point.seconds, point.error}) {
        if (!spread) continue;
        EXPECT_LE(spread->least, spread->median) << text_of(point);
        EXPECT_LE(spread->median, spread->greatest) << text_of(point);
      }
      // Both packings. Fast methods are timed twice for each packing, but some families first take the median.
      if (family.name == "equilibrium") {
        EXPECT_GE(point.seconds->n, 2) << text_of(point);
        EXPECT_LE(point.seconds->n, 4) << text_of(point);
      }
      if (family.name == "hessian" || family.name == "modes") {
        EXPECT_EQ(point.seconds->n, 2) << text_of(point);
      }
      if (family.name == "overlap") {
        EXPECT_EQ(point.error->n, 8) << text_of(point);
        // Every method computes V and S from one polyhedron, so if V is correct, S is too.
        EXPECT_LT(point.further.at("S_error_greatest").get<double>(), 1e-9) << text_of(point);
      }
    }
  }
}

/// Compares the mark of every point with the expected one. Returns how many failed.
template <class ShouldFail>
int count_failed(const std::string& family, const ShouldFail& should_fail) {
  int failed = 0, fine = 0;
  for (const ChartPoint& point : points_of(real_chart().families, family)) {
    EXPECT_EQ(point.failed, should_fail(point)) << text_of(point);
    ++(point.failed ? failed : fine);
  }
  std::printf("%s: %d failed, %d did not\n", family.c_str(), failed, fine);
  EXPECT_GT(fine, 0) << family;
  return failed;
}

/// Value that is requested by a setting of this kind; nullopt for other kinds.
std::optional<double> asked(const ChartPoint& point, const std::string& kind) {
  if (!point.setting.starts_with(kind)) return std::nullopt;
  return std::stod(point.setting.substr(kind.size()));
}

TEST(ChartPoints, FailedPointsAreMarked) {
  const int unbalanced = count_failed("equilibrium", [](const ChartPoint& point) {
    const auto residual = asked(point, "residual ");
    // The paper's rule requests no residual, so a point fails only if the rule did not stop the minimiser.
    return residual ? !(point.error->greatest <= *residual) : point.stopped != "energy_change";
  });
  const int unstable = count_failed("hessian", [](const ChartPoint& point) { return point.stopped != "done"; });
  const int lost = count_failed("modes", [](const ChartPoint& point) { return point.stopped != "converged"; });
  count_failed("overlap", [](const ChartPoint& point) { return !(point.error->greatest < 1e-2); });
  EXPECT_GT(unbalanced, 0);
  EXPECT_GT(unstable, 0);
  EXPECT_GT(lost, 0);
}

TEST(ChartPoints, TheTableMarksFailures) {
  std::istringstream table(text_table(real_chart()));
  int marked = 0, failed = 0;
  for (std::string line; std::getline(table, line);) marked += line.ends_with("  FAILED");
  for (const ChartFamily& family : real_chart().families) {
    for (const ChartPoint& point : family.points) failed += point.failed;
  }
  EXPECT_EQ(marked, failed);
}

TEST(ChartPoints, UnbalancedStatesHaveABias) {
  double ours = -1, loose = 0;
  for (const ChartPoint& point : points_of(real_chart().families, "bias")) {
    if (point.method == "newton" && point.setting == "residual 1e-06") ours = point.error->greatest;
    if (point.method == "fire" && point.error) loose = std::max(loose, point.error->greatest);
  }
  std::printf("bias of phi_J: %.1e at a residual of 1e-6, %.1e by FIRE as far as it came\n", ours, loose);
  ASSERT_GE(ours, 0);
  EXPECT_LT(ours, 1e-6 * loose);
}

}  // namespace
}  // namespace isojam
