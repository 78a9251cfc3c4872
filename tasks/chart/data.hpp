#pragma once

#include <span>
#include <string>
#include <string_view>

#include "tasks/chart/config.hpp"
#include "tasks/chart/point.hpp"

namespace isojam {

/// What the chart is drawn from, and what data.json holds (schemas/chart.schema.json): configuration, provenance,
/// families with their points, which of them lie on the Pareto front of their task, and the conclusion.
Json chart_data(const ChartConfig& config, std::span<const ChartFamily> families);

/// Of the family of that name; none if there is none.
std::span<const ChartPoint> points_of(std::span<const ChartFamily> families, std::string_view name);

/// A table of each family, and the conclusion.
std::string text_table(std::span<const ChartFamily> families);

}  // namespace isojam
