#pragma once

#include <string>
#include <vector>

#include "engine/analysis/clusters.hpp"
#include "engine/packing/packing.hpp"
#include "tasks/records/results.hpp"

namespace isojam {

struct ViewOptions {
  /// Largest total number of particles of all views with modes. Each particle takes a quarter to one millisecond and
  /// about 300 bytes.
  int budget = 2000;
  /// Largest total number of particles of all views. Each particle takes about 160 bytes, half of them for forces.
  /// Every sweep point has one view even if this number is exceeded.
  int most_particles = 40000;
  int modes = 4;  ///< number of modes at each end of the spectrum
};

/// A replicate whose packing is shown.
struct ChosenView {
  std::size_t replicate = 0;  ///< index of the replicate in the results
  bool with_modes = false;    ///< false if the number of particles would exceed the budget
};

/// Chooses the replicates whose packings are shown. For each sweep point, it chooses the first successful replicate, if
/// possible one without a flag. Then it chooses more replicates of each sweep point in turn, as long as the limits
/// allow. The result is in the order of the replicates.
std::vector<ChosenView> choose_views(const Results& results, const ViewOptions& options = {});

/// Data of a packing for the three-dimensional view. For the particles, it has positions (in the cell), orientations
/// (w, x, y, z), numbers of contacts, local Q6, and the cluster of face-face contacts. It also has the unwrapped
/// largest cluster, and the largest force (Y·V_p^(2/3)). Each contact is a row of six integers: a, b, the force in
/// thousandths of the largest force, and the point of application relative to the centre of a in hundredths (lab
/// frame). `modes` is the number of modes at each end of the spectrum; it may be 0. A mode has ω (null if λ ≤ 0) and
/// the displacements (x, θ) of each particle in the lab frame, scaled so that the largest is 1. Missing values are
/// null.
Json packing_view(const Packing& packing, int modes);

/// {"members", "positions", "winding_rank"} of a cluster that is followed along its bonds. Its mean position is at the
/// centre of the cell.
Json unwrapped_cluster(const Packing& packing, const Cluster& cluster);

/// Vertices, faces and edges of a solid in the body frame.
Json solid_shape(const ConvexSolid& solid);

}  // namespace isojam
