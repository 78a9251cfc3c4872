#pragma once

#include <array>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "engine/names/enum_names.hpp"
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
/// cluster, contact_class (the numbers of FaceContact). Field data: side, cell
/// (three lattice vectors) unless it is a cube, density, and delta_phi if the frame has it.
std::string vtp_file(const ExportFrame& frame);

/// The contact network of a frame as VTK XML PolyData. The frame must have a network. Each contact is a line with three
/// points: the centre of a, the point of application, and the centre of the touching image of b. The line is shifted so
/// that the centre of a is in the cell. Data of each line: a, b, contact_class (3, 2, 1 as in FaceContact, or −1 for
/// undecided), kind (the numbers of ContactKind), force (its magnitude), force_a, normal, volume, area, depth,
/// theta_ef, theta_ff. Field data: as vtp_file().
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

/// Formats of an export. The first three are for packings. The next three are tables with one row per contact,
/// replicate or state. The last one is a JSON object with the shapes of the solids.
enum class Exported { gsd, vtp, xyz, contacts, replicates, states, solids };
template <>
inline constexpr std::array enum_names<Exported>{EnumName{Exported::gsd, "gsd"},
                                                 EnumName{Exported::vtp, "vtp"},
                                                 EnumName{Exported::xyz, "xyz"},
                                                 EnumName{Exported::contacts, "contacts"},
                                                 EnumName{Exported::replicates, "replicates"},
                                                 EnumName{Exported::states, "states"},
                                                 EnumName{Exported::solids, "solids"}};

struct ExportedFile {
  std::filesystem::path path;
  std::string bytes;
};

/// Makes the files of one replicate, in the order in which they must be written: a file refers only to earlier ones.
/// - gsd: the file `output`.
/// - xyz: the file `output`, and the shape of each solid as an .obj file in the same folder. If particles differ in
///   solid or size, the name of the solid is part of the name of its .obj file.
/// - vtp without `collection`: the file `output`.
/// - vtp with `collection`: one file for each frame, with names that end in _0000.vtp, _0001.vtp, …, and a .pvd file.
///   The names begin with `output` without the extension .vtp or .pvd. The time of a frame is its Δφ. If any frame has
///   no Δφ, the time of every frame is its index.
///
/// For vtp, frames with a contact network have a second set of files, whose names end in -contacts before the
/// extension. Other formats are not of packings and give no files. Throws UsageError if `output` for xyz has the
/// extension .obj.
std::vector<ExportedFile> exported_files(std::span<const ExportFrame> frames, Exported format, bool collection,
                                         const std::filesystem::path& output);

}  // namespace isojam
