#pragma once

#include <span>
#include <string>
#include <vector>

#include "tasks/extras/chart/atlas/atlas.hpp"

namespace isojam {

/// A group of cells of one regime and method with the same verdict.
struct AtlasRun {
  std::string regime, method;
  bool standard = false;
  AtlasVerdict verdict = AtlasVerdict::holds;
  std::string settings;  ///< "1e-04 … 1e-08, 1e-12": neighbours in the atlas as ranges
  std::string figure;    ///< of the first cell
  std::string reason;    ///< reason of the first cell; all cells of a group that does not hold have the same reason
};

/// Makes a short form of the atlas. Regimes and methods have the same order as in the atlas. For each of them, the
/// group that holds comes first, then one group for each other reason.
std::vector<AtlasRun> atlas_runs(std::span<const AtlasRow> rows);

}  // namespace isojam
