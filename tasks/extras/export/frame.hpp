#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "engine/packing/packing.hpp"
#include "tasks/extras/export/contact_network.hpp"

namespace isojam {

/// The class of the contacts of a face. If they have different classes, it is the class with the most constraints. The
/// numbers are written to files.
enum class FaceContact : std::int32_t {
  undecided = -1,  ///< the face has contacts, but their classes are undecided, because a fit found no cut-off
  none = 0,
  lower_order = 1,
  edge_face = 2,
  face_face = 3
};

/// The FaceContact of a face whose only contact has this class.
FaceContact strength_of(ContactClass contact_class);

/// One state, with the properties that viewers show. N is the number of particles.
struct ExportFrame {
  static constexpr int no_cluster = -1;         ///< the particle has no face-face contact
  static constexpr int undecided_cluster = -2;  ///< the classes of the contacts are undecided

  Packing packing;
  std::optional<double> delta_phi;  ///< φ − φ_J; nullopt if there is no φ_J
  std::vector<std::int32_t> Z;      ///< number of contacts of each particle; N elements
  /// For each particle, the smallest index of a particle in its cluster, or one of the constants above; N elements.
  std::vector<std::int32_t> cluster;
  /// FaceContact of every face; that of face f of particle i has the index first_face[i] + f. The faces of a contact
  /// are those of contact_faces(). If the classes are undecided, the faces of a contact are all faces that bound its
  /// intersection.
  std::vector<FaceContact> faces;
  /// index of the first face of each particle; N + 1 elements, the last of which is the total number of faces
  std::vector<std::size_t> first_face{};
  std::optional<std::vector<NetworkContact>> network{};  ///< contact network, if requested

  const ConvexSolid& solid(std::size_t particle) const { return packing.solids[particle]; }
};

/// Makes a frame. Contacts, classes and clusters are computed in the same way as in records. The contact network takes
/// about 50 µs per contact. Throws std::invalid_argument if the cell is so small that a particle could touch two images
/// of another one.
ExportFrame make_frame(Packing packing, std::optional<double> delta_phi, bool with_network = false, double gap = 0);

/// Throws std::invalid_argument if there is no frame, or if the frames have different particles.
void check_frames(std::span<const ExportFrame> frames);

/// A position that was wrapped into the cell, and the lattice translation: position = wrapped + h·image, where the
/// columns of h are the lattice vectors.
struct WrappedPosition {
  Eigen::Vector3d wrapped;
  Eigen::Vector3i image;
};

/// Wraps a position so that its coordinates along the lattice vectors are in [0, 1).
WrappedPosition into_cell(const PeriodicCell& cell, const Eigen::Vector3d& position);
/// Wraps a position so that its coordinates along the lattice vectors are in [−½, ½). For a cube, they are still in
/// this interval after the position and the side are rounded to single precision.
WrappedPosition into_centred_cell(const PeriodicCell& cell, const Eigen::Vector3d& position);

/// The rotation that turns the first lattice vector along x and the second one into the xy plane. It is the identity if
/// the cell is a cube.
Eigen::Matrix3d to_standard_frame(const PeriodicCell& cell);
/// The packing, rotated by to_standard_frame(). File formats that describe a cell by tilt factors require this. A
/// packing in a cube is unchanged. In any other cell, the coordinates lose the second double of their double-double,
/// and have only double precision.
Packing in_standard_frame(Packing packing);

}  // namespace isojam
