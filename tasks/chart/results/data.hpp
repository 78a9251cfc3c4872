#pragma once

#include <span>
#include <string>
#include <string_view>

#include "tasks/chart/config/config.hpp"
#include "tasks/chart/results/chart_result.hpp"

namespace isojam {

/// What the chart is drawn from, and what data.json holds (schemas/chart_data.schema.json): configuration, provenance,
/// families with their points, which of them lie on the Pareto front of their task, the atlas, what the parts cost, and
/// the conclusion.
Json chart_data(const ChartConfig& config, const ChartResult& result);

/// The family of that name; none if there is none.
std::span<const ChartPoint> points_of(std::span<const ChartFamily> families, std::string_view name);

/// A table of each family and of the atlas, what the parts cost, and the conclusion.
std::string text_table(const ChartResult& result);

}  // namespace isojam
