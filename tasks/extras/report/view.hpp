#pragma once

#include <span>
#include <string>
#include <vector>

#include "engine/analysis/clusters.hpp"
#include "engine/packing/packing.hpp"
#include "tasks/io/json.hpp"

namespace isojam {

struct ViewOptions {
  /// Largest total number of particles of all views that have modes. Each particle takes 0.25 to 1 ms and about 300
  /// bytes.
  int budget = 2000;
  /// Largest total number of particles of all views. Each particle takes about 160 bytes, half of them for forces.
  /// Every sweep point has at least one view, even if this number is then exceeded.
  int most_particles = 40000;
  int modes = 4;  ///< number of modes at each end of the spectrum
};

/// What choose_views() needs of a replicate.
struct Viewable {
  std::string name, point;
  int particles = 0;
  bool failed = false, flagged = false;
};

/// A replicate whose packing is shown.
struct ChosenView {
  std::size_t replicate = 0;  ///< index of the replicate
  /// true if the view has modes; false if the total number of particles of views with modes would exceed `budget`
  bool with_modes = false;
};

/// Chooses the replicates whose packings are shown. First it chooses one replicate of each sweep point: the first one
/// that did not fail and has no flag, or else the first one that did not fail. Then it repeatedly adds one more
/// replicate of each sweep point, as long as the limits in ViewOptions allow. The result is sorted by the index of the
/// replicate.
std::vector<ChosenView> choose_views(std::span<const Viewable> all, const ViewOptions& options = {});

/// Data of a packing for the three-dimensional view.
/// - For each particle: its position in the cell, orientation (w, x, y, z), number of contacts, local Q6, and cluster.
/// - The largest cluster, see unwrapped_cluster().
/// - Six integers for each contact, one contact after another: a, b, the force in thousandths of the largest force, and
///   the point where the line of action leaves a. The point is relative to the centre of a, in hundredths of V_p^(1/3)
///   (lab frame). The largest force is given in units of Y·V_p^(2/3).
/// - The modes at both ends of the spectrum. Their number at each end is `modes`, which may be 0. A mode has its
///   frequency ω and the displacements (x, θ) of each particle in the lab frame. These are scaled so that the component
///   with the largest magnitude is ±1. If the eigenvalue is not positive, ω is null.
///
/// Missing values are null.
Json packing_view(const Packing& packing, int modes, double gap = 0);

/// {"members", "positions", "winding_rank"} of a cluster. Positions are followed along the contacts, without jumps at
/// the faces of the cell, and shifted so that their mean is the centre of the cell.
Json unwrapped_cluster(const Packing& packing, const Cluster& cluster);

/// The circumradius, vertices, faces and edges of a solid in its body frame.
Json solid_shape(const ConvexSolid& solid);

}  // namespace isojam
