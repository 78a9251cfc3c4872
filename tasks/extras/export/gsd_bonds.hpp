#pragma once

#include <vector>

#include "tasks/extras/export/contact_network.hpp"
#include "tasks/packings/gsd_layer.hpp"

namespace isojam {

/// A contact network as bonds of the schema "hoomd". The types of the bonds are face_face, edge_face, lower_order and
/// undecided, by the fitted cut-offs. For each bond, log/bonds/isojam/ has force (on the first particle, 3 columns),
/// volume, area, depth, theta_ef, theta_ff, and kind (the numbers of ContactKind). `rotation` rotates vectors of the
/// packing to the frame of the file.
std::vector<GsdChunk> bond_chunks(const std::vector<NetworkContact>& network, const Eigen::Matrix3d& rotation);

}  // namespace isojam
