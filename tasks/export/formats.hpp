#pragma once

#include <span>
#include <string>

#include "tasks/export/frame.hpp"

// Files for other programs: functions from frames to the bytes of a file, the same bytes from the same frames. Frames
// are given in order of expansion, have the same particles, and are at least one; functions of
// several throw std::invalid_argument otherwise. Lengths in V_p^(1/3).

namespace isojam {

/// GSD with the schema "hoomd" 1.4, as HOOMD-blue and OVITO read it. Box and particles in single precision, particles
/// wrapped into the box about the origin; a type for each solid in each size, its shape in particles/type_shapes;
/// logged: isojam/phi, isojam/side and, if every frame has one, isojam/delta_phi in double precision,
/// particles/isojam/Z and particles/isojam/cluster; and the network, of frames that have it, as bond_chunks().
/// Diameters are left at their default, as viewers scale shapes by them.
std::string gsd_file(std::span<const ExportFrame> frames);

/// VTK XML PolyData in ASCII: the faces of every particle, wound outwards, with vertices of its own. Particles are
/// moved whole so that their centres lie in [0, L)³. Cell data per face: particle, Z, cluster, contact_class (the
/// numbers of FaceContact). Field data: side, phi, delta_phi if there is one.
std::string vtp_file(const ExportFrame& frame);

/// The network of a frame that has it, as VTK XML PolyData: of every contact a line from the centre of a by the point
/// of attack to the centre of the touching image of b, a moved as vtp_file() moves it. Cell data: a, b, contact_class
/// (3, 2, 1 as of FaceContact, -1 undecided), kind (the numbers of ContactKind), force (its size), force_a, normal,
/// volume, area, depth, theta_ef, theta_ff. Field data as of vtp_file().
std::string vtp_lines_file(const ExportFrame& frame);

/// A file of a collection, by its name from where the collection lies, and its time.
struct TimedFile {
  std::string name;
  double time = 0;
};

/// A ParaView collection (.pvd).
std::string pvd_file(std::span<const TimedFile> files);

/// Extended XYZ: species (the solid), of mixtures its size, centre in [0, L)³, orientation (x, y, z, w), Z and cluster.
std::string xyz_file(std::span<const ExportFrame> frames);

/// The solid in its body frame and size, faces wound outwards, as Wavefront OBJ.
std::string obj_file(const ConvexSolid& solid);

}  // namespace isojam
