#pragma once

#include <fmt/format.h>

#include <cstddef>
#include <iterator>
#include <string>
#include <string_view>

#include "tasks/extras/export/frame.hpp"

namespace isojam {

// Common parts of VTK files.

using Text = std::back_insert_iterator<std::string>;

/// Appends an array with the values values(k) for k = 0, …, count − 1. Each line of text contains `per_line` values.
template <class Values>
void append_array(std::string& xml, std::string_view type, std::string_view attributes, std::size_t count,
                  std::size_t per_line, const Values& values) {
  fmt::format_to(Text(xml), "<DataArray type=\"{}\" {} format=\"ascii\">\n", type, attributes);
  for (std::size_t k = 0; k < count; ++k) {
    fmt::format_to(Text(xml), "{}{}", values(k), (k + 1) % per_line == 0 || k + 1 == count ? '\n' : ' ');
  }
  xml += "</DataArray>\n";
}

/// The beginning of a PolyData file, up to the element Piece. Field data: side, cell (three lattice vectors) unless it
/// is a cube, density, and delta_phi if the frame has it. `explanation` is an XML comment, or empty.
std::string vtk_head(const ExportFrame& frame, std::string_view explanation);

/// The end of a PolyData file, from the end of the element Piece.
inline constexpr std::string_view vtk_foot = "</Piece>\n</PolyData>\n</VTKFile>\n";

}  // namespace isojam
