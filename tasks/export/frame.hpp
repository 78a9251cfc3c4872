#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "engine/packing/packing.hpp"
#include "tasks/export/contacts/contact_network.hpp"

namespace isojam {

/// The strongest contact that a face takes part in, by its number of constraints. The numbers are written to files.
enum class FaceContact : std::int32_t {
  undecided = -1,  ///< touched, but the fits gave no cut-offs to classify contacts
  none = 0,
  lower_order = 1,
  edge_face = 2,
  face_face = 3
};

/// The strength of a contact of this class.
FaceContact strength_of(ContactClass contact_class);

/// One state of an expansion with the properties that pictures show. N is the number of particles.
struct ExportFrame {
  static constexpr int no_cluster = -1;         ///< no face-face contact
  static constexpr int undecided_cluster = -2;  ///< classes of contacts undecided

  Packing packing;
  std::optional<double> delta_phi;  ///< φ − φ_J; nullopt without a jamming point
  std::vector<std::int32_t> Z;      ///< N: contact number of each particle
  /// N: the smallest index of a particle in the same cluster of face-face contacts, or one of the constants above.
  std::vector<std::int32_t> cluster;
  /// Face f of particle i is at first_face[i] + f, from contact_faces. For undecided contacts all faces that bound the
  /// intersection are marked.
  std::vector<FaceContact> faces;
  std::vector<std::size_t> first_face{};                 ///< N + 1; the last is the total number
  std::optional<std::vector<NetworkContact>> network{};  ///< contact network, if requested

  const ConvexSolid& solid(std::size_t particle) const { return packing.solids[particle]; }
};

/// Finds contacts, their classes and their clusters as in the measures. The network takes about 50 µs per contact.
/// Throws std::invalid_argument if the cell is not larger than least_side() of the widest solid.
ExportFrame make_frame(Packing packing, std::optional<double> delta_phi, bool with_network = false);

/// Throws std::invalid_argument if there is no frame, or if the frames have different particles.
void check_frames(std::span<const ExportFrame> frames);

/// A position wrapped into the cell, and the number of lattice vectors: position = wrapped + h·image.
struct WrappedPosition {
  Eigen::Vector3d wrapped;
  Eigen::Vector3i image;
};

/// Wraps into [0, 1) along each lattice vector.
WrappedPosition into_cell(const PeriodicCell& cell, const Eigen::Vector3d& position);
/// Wraps into [−½, ½) along each lattice vector. In a cube this also holds in single precision, because the components
/// and the side L are stored as floats.
WrappedPosition into_centred_cell(const PeriodicCell& cell, const Eigen::Vector3d& position);

/// Rotation of a packing to the frame of formats with tilts; the identity for a cube.
Eigen::Matrix3d to_standard_frame(const PeriodicCell& cell);
/// The packing rotated so that its first lattice vector lies along x and the second in the xy plane, as formats with
/// tilts require. A cube is unchanged.
Packing in_standard_frame(Packing packing);

}  // namespace isojam
