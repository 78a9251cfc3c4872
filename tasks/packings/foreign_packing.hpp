#pragma once

#include <Eigen/Core>
#include <string>
#include <string_view>
#include <vector>

#include "engine/packing/mixture/mixture.hpp"
#include "engine/packing/packing.hpp"
#include "tasks/packings/gsd_file.hpp"

namespace isojam {

/// A packing read from another program's file, in that file's units and body frames.
struct ForeignPacking {
  struct Type {
    std::string name;
    std::vector<Eigen::Vector3d> vertices;  ///< in the body frame; empty if the file gives no shape
  };
  struct Body {
    int type = 0;
    double size = 1;  ///< ratio of its lengths to those of its type
    Eigen::Vector3d position = Eigen::Vector3d::Zero();
    Eigen::Quaterniond orientation = Eigen::Quaterniond::Identity();
  };
  Eigen::Matrix3d cell = Eigen::Matrix3d::Zero();  ///< lattice vectors as columns
  std::vector<Type> types;
  std::vector<Body> bodies;
};

/// Reads a frame (−1: the last) of a GSD file with HOOMD-blue's schema: box, positions, orientations, and shapes of
/// types if there are any. Throws NoPackingFile.
ForeignPacking read_gsd_packing(const std::string& bytes, int frame);

/// Reads a frame (−1: the last) of an extended XYZ file: Lattice, species (the name of a solid), pos, orientation (x,
/// y, z, w), and size if there are several. Throws NoPackingFile.
ForeignPacking read_xyz_packing(std::string_view text, int frame);

/// The packing in terms of the mixture's particles. Types are matched to solids by shape, up to rotation and shift, or
/// by name if the file has no shape. Lengths are scaled so that the mean volume is 1. Sizes, which files hold in single
/// precision, are replaced by those of the mixture. Throws NoPackingFile for other particles.
Packing packing_of(const ForeignPacking& foreign, const Mixture& mixture);

}  // namespace isojam
