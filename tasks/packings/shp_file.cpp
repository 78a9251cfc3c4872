#include <fmt/format.h>

#include <algorithm>

#include "tasks/packings/content_error.hpp"
#include "tasks/packings/mesh.hpp"
#include "tasks/packings/text_lines.hpp"

namespace isojam {
namespace {

/// Largest rounding radius, relative to the extent of the shape, that is neglected.
constexpr double negligible_radius = 1e-4;

std::size_t count_of(const TextLines& lines, std::size_t most) {
  if (lines.words().size() < 2) lines.refuse("a number is missing");
  return static_cast<std::size_t>(lines.integer(lines.words()[1], 0, static_cast<long>(most), "number of elements"));
}

void next_of(TextLines& lines, std::string_view noun) {
  if (!lines.next()) lines.refuse(fmt::format("the file ends in the list of {}", noun), "complete the list");
}

void read_faces(TextLines& lines, Mesh& mesh) {
  for (auto left = count_of(lines, most_faces); left > 0; --left) {
    next_of(lines, "faces");
    const auto& words = lines.words();
    const auto points = static_cast<long>(mesh.points.size());
    const auto corners = static_cast<std::size_t>(lines.integer(words[0], 3, points, "number of corners"));
    if (words.size() != corners + 1) lines.refuse(fmt::format("the face does not list {} corners", corners));
    Mesh::Face face{{}, lines.number()};
    for (std::size_t k = 1; k <= corners; ++k)
      face.points.push_back(static_cast<std::size_t>(lines.integer(words[k], 0, points - 1, "index of a vertex")));
    mesh.faces.push_back(std::move(face));
  }
}

}  // namespace

Mesh read_shp(std::string_view text) {
  TextLines lines(text, '#');
  Mesh mesh;
  double radius = 0;
  while (lines.next()) {
    const auto& words = lines.words();
    if (words[0] == "<" && !mesh.points.empty())
      lines.refuse("the file contains more than one shape", "write each shape to its own file");
    if (words[0] == "radius" && words.size() == 2) {
      radius = lines.real(words[1]);
    } else if (words[0] == "nv") {
      for (auto left = count_of(lines, most_points); left > 0; --left) {
        next_of(lines, "vertices");
        if (lines.words().size() != 3) lines.refuse("a vertex does not have three coordinates");
        mesh.points.push_back(point_of(lines, lines.words(), 0));
      }
    } else if (words[0] == "ne") {
      for (auto left = count_of(lines, most_points); left > 0; --left) next_of(lines, "edges");
    } else if (words[0] == "nf") {
      read_faces(lines, mesh);
    }
  }
  if (mesh.points.empty()) throw ContentError("the file contains no vertices");
  Eigen::Vector3d low = mesh.points[0], high = low;
  for (const auto& point : mesh.points) low = low.cwiseMin(point), high = high.cwiseMax(point);
  const double extent = (high - low).norm();
  if (radius > negligible_radius * extent)
    throw ContentError(fmt::format("the edges are rounded with the radius {:g}, which is {:.2g} of the extent", radius,
                                   radius / extent),
                       fmt::format("set radius to {:.1g} or less to use the solid with sharp edges",
                                   0.5 * negligible_radius * extent));
  if (radius > 0) mesh.notes.push_back(fmt::format("the rounding radius {:g}", radius));
  return mesh;
}

}  // namespace isojam
