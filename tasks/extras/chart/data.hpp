#pragma once

#include <span>
#include <string>
#include <string_view>

#include "tasks/extras/chart/chart_result.hpp"
#include "tasks/extras/chart/config.hpp"

namespace isojam {

/// The content of data.json (schemas/chart_data.schema.json), which the page of the chart shows: the configuration, the
/// build, the families of points with their Pareto fronts, the atlas, the costs of the parts, and the conclusion.
Json chart_data(const ChartConfig& config, const ChartResult& result);

/// The points of the family with this name; empty if there is no such family.
std::span<const ChartPoint> points_of(std::span<const ChartFamily> families, std::string_view name);

/// The chart as text: a table for each family and for the atlas, the costs of the parts, and the conclusion.
std::string text_table(const ChartResult& result);

}  // namespace isojam
