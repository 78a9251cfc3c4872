#pragma once

#include <span>
#include <string>
#include <vector>

#include "tasks/chart/atlas/atlas.hpp"

namespace isojam {

/// Cells of one regime and method that are judged alike.
struct AtlasRun {
  std::string regime, method;
  bool standard = false;
  AtlasVerdict verdict = AtlasVerdict::holds;
  std::string settings;  ///< "1e-04 … 1e-08, 1e-12": neighbours in the atlas as ranges
  std::string figure;    ///< of the first of them
  std::string reason;    ///< of the first of them; cells that do not hold have it in common
};

/// The atlas in few lines: regimes and methods in the order in which they come, and of each what holds first; then what
/// does not, a run for each reason.
std::vector<AtlasRun> atlas_runs(std::span<const AtlasRow> rows);

}  // namespace isojam
