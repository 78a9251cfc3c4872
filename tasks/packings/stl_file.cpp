#include <fmt/format.h>

#include <array>
#include <bit>
#include <cstdint>
#include <cstring>

#include "tasks/packings/content_error.hpp"
#include "tasks/packings/mesh.hpp"
#include "tasks/packings/text_lines.hpp"

namespace isojam {
namespace {

static_assert(std::endian::native == std::endian::little, "binary STL is little-endian");

constexpr std::size_t head_size = 84, triangle_size = 50, normal_size = 12;

void refuse_too_many(std::size_t line) {
  throw ContentError(fmt::format("more than {} triangles", most_faces), "simplify the surface", line);
}

void expect(TextLines& lines, std::string_view keyword, std::string_view word) {
  if (word.empty())
    lines.refuse(fmt::format("the file ends where {} should follow", in_quotes(keyword)), "complete the last facet");
  if (lower_case(word) != keyword) lines.refuse(fmt::format("{} instead of {}", in_quotes(word), in_quotes(keyword)));
}

/// Reads a facet after its first word. Its normal is not used; writers often set it to zero or nan.
void read_facet(TextLines& lines, Mesh& mesh) {
  Mesh::Face face{{}, lines.number()};
  auto word = lines.next_word();
  if (lower_case(word) == "normal") {
    for (int c = 0; c < 3; ++c) lines.next_word();
    word = lines.next_word();
  }
  expect(lines, "outer", word);
  expect(lines, "loop", lines.next_word());
  for (word = lines.next_word(); lower_case(word) == "vertex"; word = lines.next_word()) {
    if (face.points.size() == 3) lines.refuse("a facet has more than three corners", "split it into triangles");
    face.points.push_back(mesh.points.size());
    Eigen::Vector3d& point = mesh.points.emplace_back();
    for (double& x : point) x = coordinate_in(lines, lines.next_word());
  }
  if (face.points.size() < 3)
    lines.refuse(fmt::format("{} after {} of 3 corners of a facet",
                             word.empty() ? "the file ends" : in_quotes(word) + " follows", face.points.size()),
                 "write three lines \"vertex x y z\" for each facet");
  expect(lines, "endloop", word);
  expect(lines, "endfacet", lines.next_word());
  if (mesh.faces.size() == most_faces) refuse_too_many(lines.number());
  mesh.faces.push_back(std::move(face));
}

}  // namespace

Mesh read_text_stl(std::string_view text) {
  TextLines lines(text, '#');
  Mesh mesh;
  while (lines.next()) {
    expect(lines, "solid", lines.next_word());
    lines.skip_line();  // its name may contain any words
    for (;;) {
      const auto word = lines.next_word();
      // Some writers omit the last line. If facets are missing too, the surface is not closed.
      if (word.empty() || lower_case(word) == "endsolid") break;
      expect(lines, "facet", word);
      read_facet(lines, mesh);
    }
  }
  return mesh;
}

Mesh read_binary_stl(std::string_view bytes) {
  std::uint32_t count = 0;
  if (bytes.size() < head_size) throw ContentError("the file is binary, and too short for an STL file");
  std::memcpy(&count, bytes.data() + head_size - sizeof count, sizeof count);
  const std::size_t end = head_size + triangle_size * std::size_t{count};
  if (end > bytes.size())
    throw ContentError(
        fmt::format(
            "the header announces {} triangles ({} bytes), but the file has {} bytes, so it is truncated or has "
            "another format",
            count, end, bytes.size()),
        "copy or save it again");
  if (count > most_faces) refuse_too_many(0);
  Mesh mesh;
  for (std::size_t at = head_size; at < end; at += triangle_size) {
    std::array<float, 9> value{};
    std::memcpy(value.data(), bytes.data() + at + normal_size, sizeof value);
    Mesh::Face face;
    for (std::size_t k = 0; k < value.size(); k += 3) {
      face.points.push_back(mesh.points.size());
      const Eigen::Vector3d point(value[k], value[k + 1], value[k + 2]);
      // Written so that NaN is refused too.
      if (!(point.cwiseAbs().maxCoeff<Eigen::PropagateNaN>() <= largest_coordinate))
        throw ContentError(fmt::format("a coordinate of triangle {} is not finite or is beyond {:g}", mesh.faces.size(),
                                       largest_coordinate));
      mesh.points.push_back(point);
    }
    mesh.faces.push_back(std::move(face));
  }
  if (const auto more = bytes.size() - end; more > 0)
    mesh.notes.push_back(fmt::format("{} {} after the last triangle", more, more == 1 ? "byte" : "bytes"));
  return mesh;
}

}  // namespace isojam
