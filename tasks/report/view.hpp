#pragma once

#include <string>
#include <vector>

#include "engine/analysis/clusters.hpp"
#include "engine/packing/packing.hpp"
#include "tasks/store/results.hpp"

namespace isojam {

struct ViewOptions {
  /// Particles of all views with modes together, a quarter to one millisecond and some 300 bytes each.
  int budget = 2000;
  /// Particles of all views together, some 160 bytes each, half of them forces. The one view of every sweep point is
  /// made even beyond it.
  int most_particles = 40000;
  int modes = 4;  ///< vibrations at either end of the spectrum
};

/// A replicate whose packing is worth looking at.
struct ChosenView {
  std::size_t replicate = 0;  ///< index in the results
  bool with_modes = false;    ///< beyond the budget views go without
};

/// Chooses of each sweep point the first replicate without failure, an unflagged one if there is one; then further
/// ones, sweep points in turn, as long as there is room. In order of replicates.
std::vector<ChosenView> choose_views(const Results& results, const ViewOptions& options = {});

/// A packing for the three-dimensional view: positions (in the cell), orientations (w, x, y, z), per particle its
/// contacts, local Q6 and cluster of face-face contacts, the largest cluster unwrapped, its largest force
/// (Y·V_p^(2/3)), per contact six integers in a row (a, b, force in thousandths of the largest, the place where it acts
/// from the centre of a in hundredths, lab frame), and `modes` vibrations at either end (0: none), each with ω (null
/// where λ ≤ 0) and its displacements, per particle (x, θ) in the lab frame, the greatest 1. Absent: null.
Json packing_view(const Packing& packing, int modes);

/// {"members", "positions", "winding_rank"} of a cluster followed along its bonds, its mean position the centre of the
/// cell.
Json unwrapped_cluster(const Packing& packing, const Cluster& cluster);

/// Vertices, faces and edges of a solid, body frame.
Json solid_shape(const ConvexSolid& solid);

}  // namespace isojam
