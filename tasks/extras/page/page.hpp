#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "tasks/io/json.hpp"

namespace isojam {

/// A file that is part of HTML pages and was compiled into the program.
struct PagePart {
  enum class Kind : std::uint8_t {
    frame,   ///< HTML with a placeholder for the parts of each other kind
    notice,  ///< licences of the libraries
    /// CSS
    style,
    constant,  ///< JSON that is the value of the constant `name` in scripts
    module,    ///< a CommonJS module of Vega; other modules refer to it by `name`
    script     ///< a script; scripts run unchanged, in the order of the parts
  };
  Kind kind;
  std::string_view name;
  std::string_view text;
};

// These lists are generated when the program is built. Parts are in the order in which they appear in a page.

/// Parts of every page: Vega, the code that loads it, and the code that draws figures.
std::span<const PagePart> common_parts();
/// Additional parts of the report of a study.
std::span<const PagePart> report_parts();
/// Additional parts of the chart, which compares the accuracy and the speed of methods.
std::span<const PagePart> chart_parts();

/// The text of a value for assembled_page(). Bytes that are not UTF-8, as in names of files, are replaced.
std::string page_text(const Json& value);

/// Makes an HTML file that shows `data`, a text of JSON. It consists of common_parts() and the parts in `own`, which
/// must contain the frame. The file is self-contained: it loads no other files. Text in `data` is never interpreted as
/// HTML.
std::string assembled_page(std::span<const PagePart> own, std::string_view data);

}  // namespace isojam
