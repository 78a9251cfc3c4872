#include <fmt/format.h>

#include "tasks/packings/content_error.hpp"
#include "tasks/packings/mesh.hpp"
#include "tasks/packings/text_lines.hpp"

namespace isojam {
namespace {

/// Index of a corner "v", "v/vt", "v//vn" or "v/vt/vn". A negative number counts from the last vertex.
std::size_t corner_of(const TextLines& lines, std::string_view word, std::size_t points) {
  const auto most = static_cast<long>(points);
  const long index = lines.integer(word.substr(0, word.find('/')), -most, most_points, "index of a vertex");
  if (index == 0) lines.refuse("a face refers to vertex 0", "number the vertices from 1");
  return static_cast<std::size_t>(index > 0 ? index - 1 : most + index);
}

void check_corners(const Mesh& mesh) {
  for (const auto& face : mesh.faces) {
    for (const auto point : face.points) {
      if (point >= mesh.points.size())
        throw ContentError(
            fmt::format("the face refers to vertex {}, but there are {} vertices", point + 1, mesh.points.size()),
            "correct the index", face.line);
    }
  }
}

/// The words of a statement, which a backslash continues on the next line.
std::vector<std::string_view> statement_of(TextLines& lines) {
  std::vector<std::string_view> words = lines.words();
  while (!words.empty() && words.back().ends_with('\\')) {
    words.back().remove_suffix(1);
    if (words.back().empty()) words.pop_back();
    if (!lines.next()) lines.refuse("the file ends in a statement that is continued", "complete the statement");
    words.insert(words.end(), lines.words().begin(), lines.words().end());
  }
  return words;
}

}  // namespace

Mesh read_obj(std::string_view text) {
  TextLines lines(text, '#');
  Mesh mesh;
  while (lines.next()) {
    const auto line = lines.number();
    const auto words = statement_of(lines);
    if (words.empty()) continue;
    const auto statement = lower_case(words[0]);
    if (statement == "v") {
      if (words.size() < 4) lines.refuse("a vertex has fewer than three coordinates");
      if (mesh.points.size() == most_points) lines.refuse(fmt::format("more than {} vertices", most_points));
      if (words.size() == 5 && lines.real(words[4]) != 1)
        lines.refuse("a vertex has a weight other than 1", "save the solid without rational weights");
      mesh.points.push_back(point_of(lines, words, 1));
    } else if (statement == "f") {
      if (words.size() < 4) lines.refuse("a face has fewer than three corners");
      if (mesh.faces.size() == most_faces) lines.refuse(fmt::format("more than {} faces", most_faces));
      Mesh::Face face{{}, line};
      for (std::size_t k = 1; k < words.size(); ++k)
        face.points.push_back(corner_of(lines, words[k], mesh.points.size()));
      mesh.faces.push_back(std::move(face));
    } else if (statement == "curv" || statement == "curv2" || statement == "surf") {
      lines.refuse("curves and curved surfaces are not supported", "save the solid with flat faces");
    }
  }
  check_corners(mesh);
  return mesh;
}

}  // namespace isojam
