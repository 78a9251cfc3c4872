#pragma once

#include <span>
#include <string>

#include "tasks/extras/page/parts.hpp"
#include "tasks/io/json.hpp"

namespace isojam {

/// The text of a value for assembled_page(). Bytes that are not UTF-8, as in names of files, are replaced.
std::string page_text(const Json& value);

/// Makes an HTML file that shows `data`, a text of JSON. It consists of common_parts() and the parts in `own`, which
/// must contain the frame. The file is self-contained: it loads no other files. Text in `data` is never interpreted as
/// HTML.
std::string assembled_page(std::span<const PagePart> own, std::string_view data);

}  // namespace isojam
