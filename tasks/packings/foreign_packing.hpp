#pragma once

#include <Eigen/Core>
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
/// there are any. Frame −1 is the last one. Throws NoPackingFile.
ForeignPacking read_gsd_packing(const std::string& bytes, int frame);

/// Reads a frame of an extended XYZ file: Lattice, species (the name of a solid), pos, orientation (x, y, z, w), and
/// size if particles have different sizes. Frame −1 is the last one. Throws NoPackingFile.
ForeignPacking read_xyz_packing(std::string_view text, int frame);

/// Converts a packing of another program to a packing with the particles of a mixture. A type is identified with the
/// solid that has the same shape, up to rotation and shift, or with the solid of the same name if the file contains no
/// shape. Lengths are scaled so that the mean volume is 1. Sizes, which files contain in single precision, are replaced
/// by the sizes of the mixture. Throws NoPackingFile if the particles are not those of the mixture.
Packing packing_of(const ForeignPacking& foreign, const Mixture& mixture);

}  // namespace isojam
