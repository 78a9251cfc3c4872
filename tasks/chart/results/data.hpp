#pragma once

#include <span>
#include <string>
#include <string_view>

#include "tasks/chart/config/config.hpp"
#include "tasks/chart/results/chart_result.hpp"

namespace isojam {

/// Data of the chart and of data.json (schemas/chart_data.schema.json): configuration, provenance, families with their
/// points, Pareto fronts of their tasks, the atlas, the costs of the parts, and the conclusion.
Json chart_data(const ChartConfig& config, const ChartResult& result);

/// The family of that name; empty if there is none.
std::span<const ChartPoint> points_of(std::span<const ChartFamily> families, std::string_view name);

/// A table of each family and of the atlas, the costs of the parts, and the conclusion.
std::string text_table(const ChartResult& result);

}  // namespace isojam
