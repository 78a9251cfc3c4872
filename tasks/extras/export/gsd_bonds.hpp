#pragma once

#include <vector>

#include "tasks/extras/export/contact_network.hpp"
#include "tasks/packings/gsd_layer.hpp"

namespace isojam {

/// Converts a contact network to bonds of the schema "hoomd". The types of bonds are face_face, edge_face, lower_order
/// and undecided. Each bond has these quantities in log/bonds/isojam/: force (on the first particle, 3 columns),
/// volume, area, depth, theta_ef, theta_ff, and kind (the numbers of ContactKind). `rotation` rotates vectors from the
/// frame of the packing to the frame of the file.
std::vector<GsdChunk> bond_chunks(const std::vector<NetworkContact>& network, const Eigen::Matrix3d& rotation);

}  // namespace isojam
