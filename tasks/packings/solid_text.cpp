#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <iterator>
#include <string_view>

#include "tasks/packings/definitions.hpp"
#include "tasks/packings/mesh.hpp"

namespace isojam {
namespace {

/// Faces that differ by less than this length, in diameters, may be joined without a warning.
constexpr double fine_tolerance = 1e-6;
/// Numbers with more digits than this are doubles, or floats that were converted to double.
constexpr std::size_t single_digits = 9;

/// Significant digits of the shortest text for a number.
std::size_t digits_of(double x) {
  std::array<char, 32> text{};  // d.ddde±dd
  const auto end = std::to_chars(text.begin(), text.end(), x, std::chars_format::scientific).ptr;
  return static_cast<std::size_t>(
      std::count_if(text.begin(), std::find(text.begin(), end, 'e'), [](char c) { return c >= '0' && c <= '9'; }));
}

/// The precision of the vertices as they were written; empty for double precision.
std::string precision_of(const std::vector<Eigen::Vector3d>& vertices) {
  std::size_t digits = 0;
  bool single = true;
  for (const auto& v : vertices) {
    for (const double x : v) {
      digits = std::max(digits, digits_of(x));
      single = single && static_cast<double>(static_cast<float>(x)) == x;
    }
  }
  if (digits <= single_digits) return fmt::format("the vertices have {} digits; ", digits);
  return single ? "the vertices are in single precision; " : "";
}

void add(std::string& text, int count, std::string_view singular, std::string_view plural) {
  if (count == 0) return;
  text += fmt::format("{}{} {}", text.empty() ? "" : ", ", count, count == 1 ? singular : plural);
}

std::string repairs_text(const RepairReport& report) {
  std::string text;
  add(text, report.welded, "point welded", "points welded");
  add(text, report.dropped, "point omitted that is not a corner", "points omitted that are not corners");
  add(text, report.joined_faces, "face joined to a larger face", "faces joined to larger faces");
  add(text, report.removed_corners, "corner removed", "corners removed");
  if (text.empty()) return "no repairs";
  if (report.largest_move > 0) text += fmt::format("; largest move of a corner {:.2g} diameters", report.largest_move);
  if (report.volume_change != 0) text += fmt::format("; volume changed by {:.2g} %", 100 * report.volume_change);
  return text;
}

}  // namespace

std::string definition_text(const SolidDefinition& definition) {
  const auto shape = shape_of(*definition.solid);
  auto text = fmt::format(
      "{} faces, {} edges, {} vertices; volume {:.6g} before scaling; vertices within {:.2g} diameters of their faces; "
      "smallest angle between the normals of adjacent faces {:.4g} rad; {}",
      shape.faces, shape.edges, shape.vertices, shape.volume, shape.largest_distance, shape.smallest_angle,
      repairs_text(definition.report));
  for (const auto& part : definition.omitted) text += "; not used: " + part;
  return text;
}

std::string precision_warning(const Solid& solid) {
  const auto shape = shape_of(*solid);
  if (shape.tolerance > fine_tolerance)
    return fmt::format(
        "the coordinates are so large that faces less than {:.2g} diameters apart cannot be distinguished and are "
        "joined; move the origin near the solid",
        shape.tolerance);
  if (!(shape.smallest_angle < suspect_angle)) return "";
  const auto& first = solid->faces()[static_cast<std::size_t>(shape.angle_faces[0])].vertices;
  const auto& second = solid->faces()[static_cast<std::size_t>(shape.angle_faces[1])].vertices;
  std::vector<int> shared;
  std::copy_if(first.begin(), first.end(), std::back_inserter(shared),
               [&](int v) { return std::find(second.begin(), second.end(), v) != second.end(); });
  const auto& given = solid->given();
  const auto remedy = shape.suggested_merge > 0
                          ? fmt::format("if they are one face, set \"merge\" to {:g}", shape.suggested_merge)
                          : std::string("if they are one face, write the vertices with more digits");
  return fmt::format("the normals of the two faces at the edge from {} to {} differ by only {:.2g} rad; {}{}",
                     point_text(given[static_cast<std::size_t>(shared.front())]),
                     point_text(given[static_cast<std::size_t>(shared.back())]), shape.smallest_angle,
                     precision_of(given), remedy);
}

}  // namespace isojam
