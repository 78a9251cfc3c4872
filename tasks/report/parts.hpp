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

/// In the order in which they stand in the page. Generated when the program is built.
std::span<const PagePart> page_parts();

}  // namespace isojam
