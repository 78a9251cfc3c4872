#include "tasks/packings/mesh.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "tasks/packings/content_error.hpp"

namespace isojam {

double coordinate_in(const TextLines& lines, std::string_view word) {
  const double x = lines.real(word);
  if (std::abs(x) > largest_coordinate)
    lines.refuse(fmt::format("the coordinate {} is beyond {:g}", word, largest_coordinate),
                 "use a larger unit of length");
  return x;
}

Eigen::Vector3d point_of(const TextLines& lines, std::span<const std::string_view> words, std::size_t first) {
  return {coordinate_in(lines, words[first]), coordinate_in(lines, words[first + 1]),
          coordinate_in(lines, words[first + 2])};
}

std::string point_text(const Eigen::Vector3d& point) {
  return fmt::format("({:.6g}, {:.6g}, {:.6g})", point.x(), point.y(), point.z());
}

Mesh read_mesh(std::string_view bytes) {
  const bool utf16 = bytes.starts_with("\xFF\xFE") || bytes.starts_with("\xFE\xFF");
  // A binary OFF file contains zero bytes too; its first line is text.
  const bool off = lower_case(bytes.substr(0, bytes.find('\n'))).find("off binary") != std::string::npos;
  if (bytes.starts_with("ply\n") || bytes.starts_with("ply\r")) return read_ply(bytes);
  if (!utf16 && !off && bytes.find('\0') != std::string_view::npos) return read_binary_stl(bytes);
  TextLines lines(bytes, '#');
  if (!lines.next()) throw ContentError("the file is empty");
  const auto word = lower_case(lines.words().front());
  if (word == "solid") return read_text_stl(bytes);
  if (const auto at = word.find("off"); at != std::string::npos) {
    if (word.find_first_not_of("0123456789", at + 3) == std::string::npos) return read_off(bytes);
  }
  if (word == "<") return read_shp(bytes);
  constexpr std::array<std::string_view, 12> obj{"v", "vn", "vt", "vp", "f",      "g",
                                                 "o", "s",  "l",  "p",  "mtllib", "usemtl"};
  if (std::find(obj.begin(), obj.end(), word) != obj.end()) return read_obj(bytes);
  lines.refuse(fmt::format("{} does not begin an OFF, STL, OBJ, PLY or SHP file", in_quotes(lines.words().front())),
               "save the solid in one of these formats");
}

}  // namespace isojam
