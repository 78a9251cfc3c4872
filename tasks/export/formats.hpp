#pragma once

#include <span>
#include <string>

#include "tasks/export/frame.hpp"

// Files for other programs: functions from frames to the bytes of a file. Equal frames give equal bytes. Frames are in
// the order of the expansion and have the same particles, and there is at least one. Functions of several frames throw
// std::invalid_argument otherwise. Lengths in V_p^(1/3).

namespace isojam {

/// GSD with the schema "hoomd" 1.4, as HOOMD-blue and OVITO read it. Box and particles are in single precision, with
/// particles wrapped into the box about the origin. There is a type for each solid in each size, with its shape in
/// particles/type_shapes. Logged: isojam/phi, isojam/side and, if every frame has one, isojam/delta_phi in double
/// precision, particles/isojam/Z and particles/isojam/cluster. Frames with a network have it as bond_chunks().
/// Diameters keep their default, because viewers scale shapes by them.
std::string gsd_file(std::span<const ExportFrame> frames);

/// VTK XML PolyData in ASCII: the faces of every particle, oriented outwards, each particle with vertices of its own.
/// Particles are shifted as a whole so that their centres lie in [0, L)³. Cell data per face: particle, Z, cluster,
/// contact_class (the numbers of FaceContact). Field data: side, phi, delta_phi if there is one.
std::string vtp_file(const ExportFrame& frame);

/// The network of a frame that has one, as VTK XML PolyData. Each contact is a line from the centre of a through the
/// point of attack to the centre of the touching image of b; a is shifted as in vtp_file(). Cell data: a, b,
/// contact_class (3, 2, 1 as in FaceContact, -1 undecided), kind (the numbers of ContactKind), force (its magnitude),
/// force_a, normal, volume, area, depth, theta_ef, theta_ff. Field data as in vtp_file().
std::string vtp_lines_file(const ExportFrame& frame);

/// A file of a collection, by its path relative to the collection, and its time.
struct TimedFile {
  std::string name;
  double time = 0;
};

/// A ParaView collection (.pvd).
std::string pvd_file(std::span<const TimedFile> files);

/// Extended XYZ: species (the solid), size for mixtures, centre in [0, L)³, orientation (x, y, z, w), Z and cluster.
std::string xyz_file(std::span<const ExportFrame> frames);

/// The solid in its body frame and size, faces oriented outwards, as Wavefront OBJ.
std::string obj_file(const ConvexSolid& solid);

}  // namespace isojam
