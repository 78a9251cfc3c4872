#pragma once

#include <string>
#include <vector>

#include "engine/analysis/clusters.hpp"
#include "engine/packing/packing.hpp"
#include "tasks/store/results.hpp"

namespace isojam {

struct ViewOptions {
  /// Largest total number of particles of views with modes; a quarter to one millisecond and about 300 bytes each.
  int budget = 2000;
  /// Largest total number of particles of all views, about 160 bytes each, half of them forces. Every sweep point has
  /// one view even beyond it.
  int most_particles = 40000;
  int modes = 4;  ///< vibrations at either end of the spectrum
};

/// A replicate whose packing is shown.
struct ChosenView {
  std::size_t replicate = 0;  ///< index in the results
  bool with_modes = false;    ///< false beyond the budget
};

/// Chooses the first successful replicate of each sweep point, an unflagged one if possible, then further ones from the
/// sweep points in turn while the limits allow. In order of replicates.
std::vector<ChosenView> choose_views(const Results& results, const ViewOptions& options = {});

/// A packing for the three-dimensional view. Particles: positions (in the cell), orientations (w, x, y, z), contacts,
/// local Q6 and cluster of face-face contacts. Also the largest cluster unwrapped, and the largest force (Y·V_p^(2/3)).
/// Contacts: six integers in a row (a, b, force in thousandths of the largest, point of action relative to the centre
/// of a in hundredths, lab frame). `modes` vibrations at either end (0: none), each with ω (null where λ ≤ 0) and its
/// displacements, per particle (x, θ) in the lab frame, the largest 1. Absent values are null.
Json packing_view(const Packing& packing, int modes);

/// {"members", "positions", "winding_rank"} of a cluster followed along its bonds, with its mean position at the centre
/// of the cell.
Json unwrapped_cluster(const Packing& packing, const Cluster& cluster);

/// Vertices, faces and edges of a solid, body frame.
Json solid_shape(const ConvexSolid& solid);

}  // namespace isojam
