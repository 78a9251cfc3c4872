#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <optional>
#include <sstream>

#include "engine/analysis/power_law.hpp"
#include "tasks/extras/chart/data.hpp"
#include "tasks/extras/chart/run_chart.hpp"

namespace isojam {
namespace {

const ChartResult& real_chart() {
  static const ChartResult result = [] {
    const ChartConfig config = parse_chart_config(
        R"({"compare": ["equilibrium", "hessian", "modes", "overlap", "phi_j", "growth"], "solids": ["octahedron"], "particles": 45,
            "packings": 2, "distances": [0.08, 0.03], "fit_window": 0.1, "tolerances": [1e-2, 1e-6],
            "difference_steps": [1e-3, 1e-8], "shifts": [1e-11], "subspaces": [60, 200], "pairs": 8, "repetitions": 2,
            "max_evaluations": 400, "rule_evaluations": 800, "point_seconds": 1e5, "total_seconds": 1e6,
            "phi_j": {"solid": "dodecahedron", "replicates": 3, "particles": [24, 30], "consolidation_step": [0.04],
                      "target_energy": [1e-5], "fit_window": [0.05, 0.1], "residual": [1e-6, 1e-3]},
            "growth": {"solids": ["dodecahedron"], "particles": [24, 48], "replicates": 2, "distances": [0.05, 0.03]}})",
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
        const Json& area = point.further.at("S_error_greatest");
        EXPECT_EQ(area.is_null(), point.method == "clip in doubles") << text_of(point);
        // The reference computes V and S from one polyhedron, so if V is correct, S is too.
        if (!area.is_null()) {
          EXPECT_LT(area.get<double>(), 1e-9) << text_of(point);
        }
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
  const int unstable =
      count_failed("hessian", [](const ChartPoint& point) { return point.further.at("negative_modes") > 0; });
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

bool usable(const ChartPoint& point) { return !point.failed && point.error && point.seconds; }

bool beats(const ChartPoint& a, const ChartPoint& b) {
  const double ta = a.seconds->median, tb = b.seconds->median, ea = a.error->median, eb = b.error->median;
  return usable(a) && a.task == b.task && ta <= tb && ea <= eb && (ta < tb || ea < eb);
}

TEST(ChartPoints, TheFrontHasTheBestPoints) {
  const Json data = chart_data(ChartConfig(), real_chart());
  int on_front = 0, all = 0;
  for (std::size_t f = 0; f < real_chart().families.size(); ++f) {
    const auto& points = real_chart().families[f].points;
    for (std::size_t k = 0; k < points.size(); ++k) {
      const bool beaten = std::any_of(points.begin(), points.end(), [&](const ChartPoint& other) {
        return points[k].error && usable(other) && beats(other, points[k]);
      });
      const bool said = data.at("families")[f].at("points")[k].at("on_front");
      on_front += said, ++all;
      if (said) {
        EXPECT_TRUE(usable(points[k]) && !beaten) << text_of(points[k]);
      } else {
        const bool twin =
            usable(points[k]) && !beaten &&
            std::any_of(points.begin(), points.begin() + static_cast<std::ptrdiff_t>(k), [&](const ChartPoint& other) {
              return usable(other) && other.task == points[k].task && other.error->median == points[k].error->median &&
                     other.seconds->median == points[k].seconds->median;
            });
        EXPECT_TRUE(!usable(points[k]) || beaten || twin) << text_of(points[k]);
      }
    }
  }
  EXPECT_GT(on_front, 0);
  EXPECT_LT(on_front, all);
}

TEST(ChartPoints, SettingsOfTheProtocolHaveDifferentNames) {
  const auto points = points_of(real_chart().families, "phi_j");
  std::vector<std::string> settings;
  for (const ChartPoint& point : points) settings.push_back(point.setting);
  EXPECT_EQ(settings, (std::vector<std::string>{"first setting, replicates 3", "replicates 2", "fit_window 0.1",
                                                "particles 30", "residual 0.001"}));
  const auto mean = [](const ChartPoint& point) { return point.further.at("phi_j").get<double>(); };
  for (const ChartPoint& point : points) {
    const bool alike = point.setting.starts_with("fit_window") || point.setting.starts_with("residual");
    const Json &difference = point.further.at("difference"), &width = point.further.at("difference_half_width");
    EXPECT_EQ(difference.is_number(), alike) << text_of(point);
    EXPECT_EQ(width.is_number(), alike) << text_of(point);
    if (!alike) continue;
    EXPECT_NEAR(difference.get<double>(), mean(point) - mean(points[0]), 1e-12) << text_of(point);
    std::printf("%s: %.1e ± %.1e replicate by replicate, of means ± %.1e\n", point.setting.c_str(),
                difference.get<double>(), width.get<double>(), point.further.at("half_width").get<double>());
  }
  // The states are the same, so another window shifts all replicates by about the same amount.
  const Json& window = points[2].further;
  EXPECT_LT(window.at("difference_half_width").get<double>(), window.at("half_width").get<double>());
}

TEST(ChartPoints, FitsOfCostsArePowerLawsOfThePoints) {
  const ChartFamily& family = real_chart().families.back();
  ASSERT_EQ(family.name, "growth");
  std::vector<std::string> methods;
  for (const GrowthFit& fit : family.fits) {
    methods.push_back(fit.method);
    std::vector<double> particles, seconds;
    for (const ChartPoint& point : family.points) {
      if (point.method != fit.method) continue;
      ASSERT_EQ(point.seconds->n, 2) << text_of(point);
      EXPECT_FALSE(point.failed) << text_of(point);
      for (const double time : {point.seconds->least, point.seconds->greatest}) {
        particles.push_back(point.further.at("particles"));
        seconds.push_back(time);
      }
    }
    const auto law = fit_power_law(particles, seconds);
    ASSERT_TRUE(law && fit.half_width) << fit.method;
    std::printf("%s: seconds as N^(%.2f ± %.2f)\n", fit.method.c_str(), fit.exponent, *fit.half_width);
    EXPECT_NEAR(fit.exponent, law->exponent, 1e-12) << fit.method;
    EXPECT_NEAR(fit.prefactor / law->prefactor, 1, 1e-12) << fit.method;
    EXPECT_EQ(fit.n, 4) << fit.method;
  }
  EXPECT_EQ(methods, (std::vector<std::string>{"replicate", "equilibrium", "evaluation"}));
  EXPECT_NE(text_table(real_chart()).find("replicate: seconds grow as N^x with x = "), std::string::npos);
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
