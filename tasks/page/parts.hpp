#pragma once

#include <cstdint>
#include <span>
#include <string_view>

namespace isojam {

/// A file that was compiled into the program.
struct PagePart {
  enum class Kind : std::uint8_t {
    frame,   ///< HTML with a place for each of the others
    notice,  ///< licences of the libraries
    style,
    module,  ///< a CommonJS module of Vega, known to the others by `name`
    script   ///< run as it stands, in order
  };
  Kind kind;
  std::string_view name;
  std::string_view text;
};

// Generated when the program is built, in the order in which they stand in a page.

/// What every page has: Vega, its loader, and what draws figures of panels with it.
std::span<const PagePart> common_parts();
/// What the report of a sweep has beside that.
std::span<const PagePart> report_parts();
/// What the chart of accuracy against speed has.
std::span<const PagePart> chart_parts();

}  // namespace isojam
