#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "tasks/packings/text_lines.hpp"

namespace isojam {

/// A polyhedron as it is written in a file: points and faces, without any repair.
struct Mesh {
  struct Face {
    std::vector<std::size_t> points;  ///< indices of its corners, in order around the face
    std::size_t line = 0;             ///< number of its line; 0 in a binary file
  };
  std::vector<Eigen::Vector3d> points;
  std::vector<Face> faces;
  std::vector<std::string> notes;  ///< content of the file that does not belong to the solid
};

// Limits that a file must not exceed. They are checked first. Scanned stones have up to some 100 000 triangles.
inline constexpr std::size_t most_faces = 500000;
inline constexpr std::size_t most_points = 3 * most_faces;  ///< each triangle may have corners of its own

/// Largest coordinate, so that squares and products of three coordinates are far from overflow.
inline constexpr double largest_coordinate = 1e9;

/// A coordinate within this limit. Throws ContentError.
double coordinate_in(const TextLines& lines, std::string_view word);
/// The point in three words, from the word with this index on.
Eigen::Vector3d point_of(const TextLines& lines, std::span<const std::string_view> words, std::size_t first);

/// The coordinates as text for messages.
std::string point_text(const Eigen::Vector3d& point);

/// The readers of the formats. They throw ContentError with the line of an error. The faces need not form a solid.
Mesh read_off(std::string_view text);
Mesh read_obj(std::string_view text);
Mesh read_ply(std::string_view bytes);
/// The shape file of Rockable and exaDEM. Its rounding radius must be negligible.
Mesh read_shp(std::string_view text);
Mesh read_text_stl(std::string_view text);
Mesh read_binary_stl(std::string_view bytes);
/// Reads a mesh in any of these formats, which are distinguished by the content.
Mesh read_mesh(std::string_view bytes);

}  // namespace isojam
