#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "engine/packing/packing.hpp"
#include "tasks/export/contacts/contact_network.hpp"

namespace isojam {

/// The strongest contact that a face takes part in, by the constraints that it makes. The numbers stand in files.
enum class FaceContact : std::int32_t {
  undecided = -1,  ///< touched, but the fits gave no cut-offs that would tell the classes of contacts
  none = 0,
  lower_order = 1,
  edge_face = 2,
  face_face = 3
};

/// What a contact of this class counts for.
FaceContact strength_of(ContactClass contact_class);

/// One state of an expansion with what pictures of it show. Sizes: N particles.
struct ExportFrame {
  static constexpr int no_cluster = -1;         ///< no face-face contact
  static constexpr int undecided_cluster = -2;  ///< classes of contacts undecided

  Packing packing;
  std::optional<double> delta_phi;  ///< φ − φ_J; none without a jamming point
  std::vector<std::int32_t> Z;      ///< N: contacts of each particle
  /// N: least number of a particle in the same cluster of face-face contacts, or one of the constants above.
  std::vector<std::int32_t> cluster;
  /// Of face f of particle i at first_face[i] + f, by contact_faces; of undecided contacts all faces that bound the
  /// intersection.
  std::vector<FaceContact> faces;
  std::vector<std::size_t> first_face{};                 ///< N + 1, the number of all at the end
  std::optional<std::vector<NetworkContact>> network{};  ///< of contacts, where it is wanted

  const ConvexSolid& solid(std::size_t particle) const { return packing.solids[particle]; }
};

/// Finds contacts, their classes and their clusters as the measurements do.
/// The network takes some 50 µs a contact. Throws std::invalid_argument if the cell is not larger than least_side() of
/// the widest solid.
ExportFrame make_frame(Packing packing, std::optional<double> delta_phi, bool with_network = false);

/// Throws std::invalid_argument unless there is a frame, and all have the same particles.
void check_frames(std::span<const ExportFrame> frames);

/// A position moved by lattice vectors into the cell, and by how many: position = wrapped + h·image.
struct WrappedPosition {
  Eigen::Vector3d wrapped;
  Eigen::Vector3i image;
};

/// Into [0, 1) of each lattice vector.
WrappedPosition into_cell(const PeriodicCell& cell, const Eigen::Vector3d& position);
/// Into [−½, ½) of each lattice vector; in a cube of side L as single precision has it too: the components are floats,
/// and so is L.
WrappedPosition into_centred_cell(const PeriodicCell& cell, const Eigen::Vector3d& position);

/// Rotation of a packing to the frame of formats with tilts; of a cube, none.
Eigen::Matrix3d to_standard_frame(const PeriodicCell& cell);
/// The packing turned so that its first lattice vector lies along x and the second in the plane of x and y, as formats
/// with tilts have it. A cube stays as it is.
Packing in_standard_frame(Packing packing);

}  // namespace isojam
