#pragma once

#include <Eigen/Core>
#include <string>
#include <string_view>
#include <vector>

#include "engine/packing/mixture/mixture.hpp"
#include "engine/packing/packing.hpp"
#include "tasks/packings/gsd_file.hpp"

namespace isojam {

/// A packing as a file of another program has it, in that file's units and frames of bodies.
struct ForeignPacking {
  struct Type {
    std::string name;
    std::vector<Eigen::Vector3d> vertices;  ///< in the body frame; none if the file tells no shape
  };
  struct Body {
    int type = 0;
    double size = 1;  ///< of its lengths to those of its type
    Eigen::Vector3d position = Eigen::Vector3d::Zero();
    Eigen::Quaterniond orientation = Eigen::Quaterniond::Identity();
  };
  Eigen::Matrix3d cell = Eigen::Matrix3d::Zero();  ///< lattice vectors as columns
  std::vector<Type> types;
  std::vector<Body> bodies;
};

/// A frame of a GSD file with HOOMD-blue's schema, −1 the last: box, positions, orientations, and shapes of types where
/// there are any. Throws NoPackingFile.
ForeignPacking read_gsd_packing(const std::string& bytes, int frame);

/// A frame of an extended XYZ file, −1 the last: Lattice, species (the name of a solid), pos, orientation (x, y, z, w),
/// and size where there are several. Throws NoPackingFile.
ForeignPacking read_xyz_packing(std::string_view text, int frame);

/// The packing of the mixture's particles that the file tells: types are its solids by shape, turned and shifted as
/// they may be, or by name where the file has no shape; lengths become those in which the mean volume is 1; sizes,
/// which files hold in single precision, become those of the mixture. Throws NoPackingFile for other particles.
Packing packing_of(const ForeignPacking& foreign, const Mixture& mixture);

}  // namespace isojam
