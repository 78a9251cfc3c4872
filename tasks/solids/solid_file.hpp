#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

namespace isojam {

/// A file that holds no convex solid; what() says why.
class NoSolidFile : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The vertices of the polyhedron in an OFF or STL file (text or binary, told by its contents), each once, in order of
/// first appearance. Vertices that no face has are left out. Throws NoSolidFile for what is no such file, and where a
/// face has vertices on both sides by more than the seven digits that such files carry: the solid is not convex.
/// Throws FileError if the file cannot be read.
std::vector<Eigen::Vector3d> read_solid_file(const std::filesystem::path& path);

}  // namespace isojam
