#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tasks/extras/chart/atlas/atlas.hpp"
#include "tasks/extras/chart/config.hpp"
#include "tasks/extras/chart/point.hpp"

namespace isojam {

/// The stability atlas of a chart, see atlas.hpp.
struct ChartAtlas {
  FamilyEnd ended = FamilyEnd::complete;
  std::vector<AtlasRow> rows;
};

/// CPU time of a part of a chart. It includes work that no point of the chart contains, such as making the packings.
struct PartCost {
  std::string part;  ///< name of a comparison; or "packings" or "equilibria", which several comparisons use
  double cpu_seconds = 0;
};

/// Results of run_chart().
// NOLINTNEXTLINE(bugprone-exception-escape): moving a Json never throws, but the check assumes that its assertions can.
struct ChartResult {
  std::vector<ChartFamily> families;
  std::optional<ChartAtlas> atlas;  ///< nullopt if the configuration does not request the atlas
  std::vector<PartCost> costs;      ///< in the order in which the parts were measured
};

/// The content of data.json, which the page of the chart shows.
struct ChartData {
  std::string schema, version, git, compiler;
  int threads = 1;
  ChartConfig config;
  ChartResult result;
};
void describe(Fields& field, ChartData& data);

/// Makes the data with the build and the Pareto fronts of the families.
Json chart_data(const ChartConfig& config, const ChartResult& result);

/// The chart as text: a table for each family and for the atlas, and the costs of the parts.
std::string text_table(const ChartResult& result);

}  // namespace isojam
