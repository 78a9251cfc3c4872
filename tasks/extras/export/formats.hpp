#pragma once

#include <span>
#include <string>

#include "tasks/extras/export/frame.hpp"

// Files for other programs. Each function converts frames to the bytes of a file; equal frames give equal bytes. Frames
// must be in the order of the decompression and have the same particles, and there must be at least one. Otherwise,
// functions of several frames throw std::invalid_argument. Lengths are in units of V_p^(1/3).

namespace isojam {

/// GSD with the schema "hoomd" 1.4, which HOOMD-blue and OVITO read. Box and particles are in single precision.
/// Particles are wrapped into the box, which is centred on the origin. There is a particle type for each solid in each
/// size; its shape is in particles/type_shapes. Logged quantities are isojam/phi, isojam/side and, if every frame has
/// it, isojam/delta_phi in double precision, and particles/isojam/Z and particles/isojam/cluster. The contact network
/// of a frame is written as bond_chunks(). Diameters keep their default value, because viewers scale shapes by the
/// diameter.
std::string gsd_file(std::span<const ExportFrame> frames);

/// VTK XML PolyData in ASCII: the faces of every particle, oriented outwards. Particles do not share vertices. Each
/// particle is shifted as a whole so that its centre is in [0, L)³. Cell data of each face: particle, Z, cluster,
/// contact_class (the numbers of FaceContact). Field data: side, phi, and delta_phi if there is one.
std::string vtp_file(const ExportFrame& frame);

/// The contact network of a frame as VTK XML PolyData. The frame must have a network. Each contact is a line from the
/// centre of a through the point of application to the centre of the touching image of b; a is shifted as in
/// vtp_file(). Cell data: a, b, contact_class (3, 2, 1 as in FaceContact, or -1 for undecided), kind (the numbers of
/// ContactKind), force (its magnitude), force_a, normal, volume, area, depth, theta_ef, theta_ff. Field data are as in
/// vtp_file().
std::string vtp_lines_file(const ExportFrame& frame);

/// A file of a collection: its path relative to the collection, and its time.
struct TimedFile {
  std::string name;
  double time = 0;
};

/// A ParaView collection (.pvd).
std::string pvd_file(std::span<const TimedFile> files);

/// Extended XYZ with the species (the name of the solid), the size for mixtures, the centre in [0, L)³, the orientation
/// (x, y, z, w), Z and the cluster.
std::string xyz_file(std::span<const ExportFrame> frames);

/// Wavefront OBJ of a solid with its actual size in the body frame. Faces are oriented outwards.
std::string obj_file(const ConvexSolid& solid);

}  // namespace isojam
