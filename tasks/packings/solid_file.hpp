#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

namespace isojam {

/// Exception: a file does not contain a convex solid. what() gives the reason.
class NoSolidFile : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Reads the vertices of the polyhedron in an OFF or STL file. Each vertex occurs once, in the order of first
/// appearance. Text and binary STL are distinguished by their content. Vertices that belong to no face are omitted.
/// Throws NoSolidFile if the file has another format, or if the solid is not convex, that is, if there are vertices on
/// both sides of a face, within the seven digits of such files. Throws FileError if the file cannot be read.
std::vector<Eigen::Vector3d> read_solid_file(const std::filesystem::path& path);

}  // namespace isojam
