#include <fmt/format.h>

#include "tasks/packings/mesh.hpp"
#include "tasks/packings/text_lines.hpp"

namespace isojam {
namespace {

/// Smallest and largest number of words in the line of a vertex, with its three coordinates.
struct VertexColumns {
  std::size_t least = 3, most = 3;

  explicit VertexColumns(const TextLines& lines, std::string_view keyword) {
    std::string_view rest = keyword;
    rest.remove_suffix(3);
    if (rest.ends_with('4') || rest.ends_with('n'))
      lines.refuse(fmt::format("{} is a file whose points do not have three coordinates", in_quotes(keyword)));
    auto lower = lower_case(rest);
    const auto take = [&](std::string_view prefix) {
      if (!lower.starts_with(prefix)) return false;
      lower.erase(0, prefix.size());
      return true;
    };
    if (take("st")) least += 2, most += 2;
    if (take("c")) least += 3, most += 4;
    if (take("n")) least += 3, most += 3;
    if (!lower.empty()) lines.refuse(fmt::format("{} is not a keyword of OFF files", in_quotes(keyword)));
  }
};

struct Counts {
  std::size_t points, faces;
};

/// The number of edges is often wrong or missing, and is not used.
Counts read_counts(TextLines& lines, std::string_view after_keyword) {
  auto words = lines.words();
  words.front() = after_keyword;
  if (after_keyword.empty()) words.erase(words.begin());
  if (!words.empty() && lower_case(words[0]) == "binary")
    lines.refuse("binary OFF files are not supported", "save the solid as text");
  if (words.empty() && lines.next()) words = lines.words();
  if (words.size() != 2 && words.size() != 3)
    lines.refuse(
        fmt::format("this line has {} words instead of the numbers of vertices, faces and edges", words.size()),
        "write these numbers on one line, and then each vertex and each face on its own line");
  const auto points = lines.integer(words[0], 4, most_points, "number of vertices");
  auto faces_word = words[1];
  if (faces_word.starts_with('f')) faces_word.remove_prefix(1);  // the library coxeter writes "4 f4 6"
  const auto faces = lines.integer(faces_word, 0, most_faces, "number of faces");
  return {static_cast<std::size_t>(points), static_cast<std::size_t>(faces)};
}

void next_of(TextLines& lines, std::size_t done, std::size_t all, std::string_view noun) {
  if (!lines.next())
    lines.refuse(fmt::format("the file ends after {} of {} {}", done, all, noun),
                 fmt::format("add the other {}, or correct the number of {}", noun, noun));
}

Mesh::Face read_face(const TextLines& lines, std::size_t points) {
  const auto& words = lines.words();
  const auto corners =
      static_cast<std::size_t>(lines.integer(words[0], 3, static_cast<long>(points), "number of corners"));
  if (words.size() < corners + 1)
    lines.refuse(fmt::format("the face has {} corners, but {} are listed", corners, words.size() - 1),
                 "correct the number at the beginning of the line");
  // A colour is an index, or three or four components.
  const auto colour = words.size() - corners - 1;
  if (colour == 2 || colour > 4)
    lines.refuse(fmt::format("{} numbers follow the {} corners of the face", colour, corners),
                 "correct the number at the beginning of the line; a colour has one, three or four numbers");
  Mesh::Face face{{}, lines.number()};
  for (std::size_t k = 1; k <= corners; ++k)
    face.points.push_back(
        static_cast<std::size_t>(lines.integer(words[k], 0, static_cast<long>(points) - 1, "index of a vertex")));
  for (std::size_t k = corners + 1; k < words.size(); ++k) lines.real(words[k]);
  return face;
}

}  // namespace

Mesh read_off(std::string_view text) {
  TextLines lines(text, '#');
  lines.next();
  // Some files have the number of vertices in the same word: "OFF8 6 12".
  const auto word = lines.words().front();
  const auto keyword = word.substr(0, lower_case(word).find("off") + 3);
  const VertexColumns columns(lines, keyword);
  const auto counts = read_counts(lines, word.substr(keyword.size()));
  Mesh mesh;
  for (std::size_t k = 0; k < counts.points; ++k) {
    next_of(lines, k, counts.points, "vertices");
    const auto& words = lines.words();
    if (words.size() < columns.least || words.size() > columns.most)
      lines.refuse(fmt::format("the line of vertex {} has {} numbers instead of {}", k, words.size(), columns.least),
                   "correct the line, the number of vertices, or the keyword: COFF for colours, NOFF for normals");
    mesh.points.push_back(point_of(lines, lines.words(), 0));
  }
  for (std::size_t k = 0; k < counts.faces; ++k) {
    next_of(lines, k, counts.faces, "faces");
    mesh.faces.push_back(read_face(lines, counts.points));
  }
  if (lines.next())
    lines.refuse(fmt::format("the file continues after {} faces", counts.faces), "correct the number of faces");
  return mesh;
}

}  // namespace isojam
