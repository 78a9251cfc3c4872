#pragma once

#include <span>
#include <string>
#include <vector>

#include "tasks/chart/atlas/atlas.hpp"

namespace isojam {

/// Cells of one regime and method with the same verdict.
struct AtlasRun {
  std::string regime, method;
  bool standard = false;
  AtlasVerdict verdict = AtlasVerdict::holds;
  std::string settings;  ///< "1e-04 … 1e-08, 1e-12": neighbours in the atlas as ranges
  std::string figure;    ///< of the first cell
  std::string reason;    ///< of the first cell; cells that do not hold share it
};

/// A short form of the atlas: regimes and methods in their order, for each first the run that holds, then one run for
/// each other reason.
std::vector<AtlasRun> atlas_runs(std::span<const AtlasRow> rows);

}  // namespace isojam
