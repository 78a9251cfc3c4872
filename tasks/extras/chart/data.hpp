#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "tasks/extras/chart/chart_result.hpp"
#include "tasks/extras/chart/config.hpp"

namespace isojam {

/// The content of data.json, which the page of the chart shows.
struct ChartData {
  std::string schema, version, git, compiler;
  int threads = 1;
  ChartConfig config;
  ChartResult result;
  std::vector<std::string> conclusion;
};
void describe(Fields& field, ChartData& data);

/// Makes the data with the build, the Pareto fronts of the families, and the conclusion.
Json chart_data(const ChartConfig& config, const ChartResult& result);

/// The points of the family with this name; empty if there is no such family.
std::span<const ChartPoint> points_of(std::span<const ChartFamily> families, std::string_view name);

/// Whole sentences: one for each residual that was requested, largest first. It states in how many cases each method
/// reaches the residual, and in how many it is the fastest. If the paper's stopping rule was measured, the last line
/// states the residuals and the errors of φ_J with this rule. The arguments are the points of the families
/// `equilibrium` and `bias`.
std::vector<std::string> conclusion(std::span<const ChartPoint> equilibrium, std::span<const ChartPoint> bias);

/// The chart as text: a table for each family and for the atlas, the costs of the parts, and the conclusion.
std::string text_table(const ChartResult& result);

}  // namespace isojam
