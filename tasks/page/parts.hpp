#pragma once

#include <cstdint>
#include <span>
#include <string_view>

namespace isojam {

/// A file that was compiled into the program.
struct PagePart {
  enum class Kind : std::uint8_t {
    frame,   ///< HTML with a placeholder for each of the other parts
    notice,  ///< licences of the libraries
    style,
    module,  ///< a CommonJS module of Vega, required by `name`
    script   ///< run unchanged, in order
  };
  Kind kind;
  std::string_view name;
  std::string_view text;
};

// Generated when the program is built, in the order in which they appear in a page.

/// Parts of every page: Vega, its loader, and the code that draws figures.
std::span<const PagePart> common_parts();
/// Additional parts of the report of a sweep.
std::span<const PagePart> report_parts();
/// Additional parts of the chart of accuracy against speed.
std::span<const PagePart> chart_parts();

}  // namespace isojam
