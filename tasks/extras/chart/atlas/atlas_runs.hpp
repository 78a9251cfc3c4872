#pragma once

#include <span>
#include <string>
#include <vector>

#include "tasks/extras/chart/atlas/atlas.hpp"

namespace isojam {

/// Cells of the atlas with the same regime, method and verdict. If the verdict is not `holds`, they also have the same
/// reason.
struct AtlasRun {
  std::string regime, method;
  /// true if isojam uses this method in this regime
  bool standard = false;
  AtlasVerdict verdict = AtlasVerdict::holds;
  /// settings of the cells, such as "1e-04 … 1e-08, 1e-12"; "…" stands for all cells between these two settings
  std::string settings;
  std::string figure;  ///< measured value in the first cell
  std::string reason;  ///< reason in the first cell
};

/// Makes a short form of the atlas. Regimes and methods have the same order as in the atlas. For each regime and
/// method, the group with the verdict `holds` comes first. One group follows for each other verdict and reason.
std::vector<AtlasRun> atlas_runs(std::span<const AtlasRow> rows);

}  // namespace isojam
