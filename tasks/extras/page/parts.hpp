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
    script   ///< a script that is run unchanged, in the order of the parts
  };
  Kind kind;
  std::string_view name;
  std::string_view text;
};

// These lists are generated when the program is built. The parts have the order in which they appear in a page.

/// Parts of every page: Vega, the code that loads it, and the code that draws figures.
std::span<const PagePart> common_parts();
/// Additional parts of the report of a sweep.
std::span<const PagePart> report_parts();
/// Additional parts of the chart of accuracy against speed.
std::span<const PagePart> chart_parts();

}  // namespace isojam
