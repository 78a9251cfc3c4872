#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tasks/extras/chart/atlas/atlas.hpp"
#include "tasks/extras/chart/point.hpp"

namespace isojam {

/// The stability atlas as a part of a chart.
struct ChartAtlas {
  FamilyEnd ended = FamilyEnd::complete;
  std::vector<AtlasRow> rows;
};

/// Cost of a part of a chart, including untimed work.
struct PartCost {
  std::string part;  ///< "packings", "equilibria" (made once for several families), or the comparison
  double cpu_seconds = 0;
};

/// Results of run_chart().
// NOLINTNEXTLINE(bugprone-exception-escape): moving a Json is noexcept; the check sees its assertions throw.
struct ChartResult {
  std::vector<ChartFamily> families;
  std::optional<ChartAtlas> atlas;  ///< nullopt unless requested
  std::vector<PartCost> costs;      ///< in the order of measurement
};

}  // namespace isojam
