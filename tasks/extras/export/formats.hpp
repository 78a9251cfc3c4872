#pragma once

#include <span>
#include <string>

#include "tasks/extras/export/frame.hpp"

// Files for other programs. Each function converts frames to the bytes of a file; equal frames give equal bytes.
// Lengths are in units of V_p^(1/3). Functions that take several frames need at least one. All frames must have the
// same particles; otherwise the functions throw std::invalid_argument.

namespace isojam {

/// GSD with the schema "hoomd" 1.4, which HOOMD-blue and OVITO read. The box and the particles are in single precision.
/// Particles are wrapped into the box, whose centre is the origin. There is one particle type for each size of each
/// solid; its shape is in particles/type_shapes. Diameters keep their default value, because viewers scale shapes by
/// the diameter.
///
/// Logged quantities (under log/): isojam/density and isojam/side in double precision; isojam/cell unless the cell is a
/// cube; isojam/delta_phi if every frame has it; particles/isojam/Z and particles/isojam/cluster. If a frame has a
/// contact network, it is written with bond_chunks().
std::string gsd_file(std::span<const ExportFrame> frames);

/// VTK XML PolyData in ASCII: the faces of every particle, oriented outwards. Particles do not share vertices. Each
/// particle is shifted as a whole so that its centre is in the cell, see into_cell(). Data of each face: particle, Z,
/// cluster, contact_class (the numbers of FaceContact). Field data: see vtk_head().
std::string vtp_file(const ExportFrame& frame);

/// The contact network of a frame as VTK XML PolyData. The frame must have a network. Each contact is a line with three
/// points: the centre of a, the point of application, and the centre of the touching image of b. The line is shifted so
/// that the centre of a is in the cell. Data of each line: a, b, contact_class (3, 2, 1 as in FaceContact, or −1 for
/// undecided), kind (the numbers of ContactKind), force (its magnitude), force_a, normal, volume, area, depth,
/// theta_ef, theta_ff. Field data: see vtk_head().
std::string vtp_lines_file(const ExportFrame& frame);

/// A file of a collection: its path relative to the collection file, and its time.
struct TimedFile {
  std::string name;
  double time = 0;
};

/// A ParaView collection (.pvd) of these files.
std::string pvd_file(std::span<const TimedFile> files);

/// Extended XYZ. Columns: species (the name of the solid), size if particles differ in solid or size, centre in the
/// cell, orientation (x, y, z, w), Z and cluster.
std::string xyz_file(std::span<const ExportFrame> frames);

/// Wavefront OBJ of a solid with its size, in its body frame. Faces are oriented outwards.
std::string obj_file(const ConvexSolid& solid);

}  // namespace isojam
