#pragma once

#include <Eigen/Core>
#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "engine/packing/mixture/mixture.hpp"
#include "engine/packing/packing.hpp"
#include "tasks/packings/gsd_file.hpp"

namespace isojam {

/// A packing that was read from a file of another program. Units and body frames are those of the file.
struct ForeignPacking {
  struct Type {
    std::string name;
    std::vector<Eigen::Vector3d> vertices;  ///< vertices in the body frame; empty if the file contains no shape
    std::string foreign_shape;              ///< text about a shape that is not a convex polyhedron; otherwise empty
    bool is_element = false;                ///< the name is a chemical symbol, which does not state a shape
  };
  struct Body {
    int type = 0;
    double size = 1;  ///< size of the particle: its lengths divided by those of its type
    Eigen::Vector3d position = Eigen::Vector3d::Zero();
    Eigen::Quaterniond orientation = Eigen::Quaterniond::Identity();
  };
  Eigen::Matrix3d cell = Eigen::Matrix3d::Zero();  ///< lattice vectors as columns
  std::vector<Type> types;
  std::vector<Body> bodies;
};

/// Reads a frame of a GSD file with the schema of HOOMD-blue: box, positions, orientations, and the shapes of types if
/// there are any. Frame −1 is the last one. Throws ContentError.
ForeignPacking read_gsd_packing(const std::string& bytes, int frame);

/// Reads a frame of an extended XYZ file: Lattice, solid or species (the name of a solid), pos, orientation (x, y, z,
/// w), and size if particles have different sizes. Frame −1 is the last one. Throws ContentError.
ForeignPacking read_xyz_packing(std::string_view text, int frame);

/// The unit quaternion. Throws ContentError if its length differs from 1 by more than numbers with four digits do.
/// `order` names the coefficients.
Eigen::Quaterniond unit_quaternion(const Eigen::Quaterniond& q, std::size_t particle, std::string_view order,
                                   std::size_t line = 0);

/// Index of a frame that /start/frame gives: from 0, or from −1 for the last one. Throws ContentError if the file does
/// not have this frame.
std::size_t index_of_frame(std::size_t frames, int frame);

/// For types of a file without shapes, the names of their solids.
using TypeNames = std::map<std::string, std::string, std::less<>>;

/// Converts a packing of another program to a packing with the particles of a mixture. A type is identified with the
/// solid that has the same shape, up to rotation and shift. Points of a shape that are not corners of its convex hull
/// are omitted, and `notes` states this. If the file contains no shape of the type, the solid has the name that `types`
/// gives, or the name of the type; elements are the only solid of a mixture. Lengths are scaled so that the mean volume
/// is 1. The sizes in the file may be rounded, and are replaced by the sizes of the mixture. Throws ContentError if the
/// particles are not those of the mixture.
Packing packing_of(const ForeignPacking& foreign, const Mixture& mixture, const TypeNames& types = {},
                   std::vector<std::string>* notes = nullptr);

}  // namespace isojam
