#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

namespace isojam {

/// The file contains no convex solid; what() gives the reason.
class NoSolidFile : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The vertices of the polyhedron in an OFF or STL file, each once, in order of first appearance. Text and binary STL
/// are distinguished by their contents. Vertices without a face are omitted. Throws NoSolidFile if the file is of
/// neither format, or if the solid is not convex: a face has vertices on both sides by more than the seven digits that
/// such files carry. Throws FileError if the file cannot be read.
std::vector<Eigen::Vector3d> read_solid_file(const std::filesystem::path& path);

}  // namespace isojam
